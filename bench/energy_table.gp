# SPDX-License-Identifier: MIT
# What energy_table prints, as a picture:
#   gnuplot -e "data='docs/data/energy_cases.csv'; out='docs/img/energy_cases.svg'" bench/energy_table.gp
set datafile separator ","
set terminal svg size 900,420 font "sans-serif,12" background "white"
set output out
set multiplot layout 1,2
set key top right opaque box linecolor "#cccccc"
set xlabel "dashpots, ratio to critical [-]"
set xrange [-0.03:1.03]
set logscale y
set format y "10^{%L}"

set title "energy above the start, of what is at stake"
set ylabel "[%], shown as 10^{-14} where there is none"
set yrange [3e-15:30]
set arrow from graph 0, first 1 to graph 1, first 1 nohead dashtype 2 linecolor "red"
set label "asked for: below 1 %" at graph 0.3, first 0.25 center textcolor "red"
floored(x) = x > 1e-14 ? x : 1e-14
plot data using ($3 == 1 ? $4 : NaN):(floored($6)) every ::1 title "one block" pointtype 6 pointsize 0.4 linecolor "#0072b2", \
     data using ($3 == 48 ? $4 : NaN):(floored($6)) every ::1 title "48 blocks" pointtype 7 pointsize 0.4 linecolor "#d55e00"

unset arrow
unset label
set title "lost by contact updates, of the same"
set ylabel "[%], shown as 10^{-5} where there is less"
set yrange [3e-6:100]
lost(x) = -x > 1e-5 ? -x : 1e-5
plot data using ($3 == 1 ? $4 : NaN):(lost($7)) every ::1 title "one block" pointtype 6 pointsize 0.4 linecolor "#0072b2", \
     data using ($3 == 48 ? $4 : NaN):(lost($7)) every ::1 title "48 blocks" pointtype 7 pointsize 0.4 linecolor "#d55e00"
unset multiplot
