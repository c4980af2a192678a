# SPDX-License-Identifier: MIT
# What far_field_table kirsch prints, as a picture:
#   gnuplot -e "data='docs/data/far_field_kirsch.csv'; out='docs/img/far_field.svg'" bench/far_field_table.gp
set datafile separator ","
set terminal svg size 900,420 font "sans-serif,12" background "white"
set output out
set multiplot layout 1,2
set xlabel "half width of the domain over radius [-]"
set xrange [2.5:9.5]
set xtics 3,1,9
set key top right opaque box linecolor "#cccccc"
set arrow from graph 0, first 1 to graph 1, first 1 nohead linecolor "#999999"
of(kind, k0) = sprintf("< grep -E '^%s,%g,[0-9.]+,20,' %s", kind, k0, data)

set title "mean convergence, over Kirsch"
set yrange [0.85:1.3]
plot of("rollers", 0.5) using 3:6 with linespoints pointtype 6 linecolor "#0072b2" title "rollers, K_0 = 0.5", \
     of("rollers", 2) using 3:6 with linespoints pointtype 7 linecolor "#0072b2" title "rollers, K_0 = 2", \
     of("stress", 0.5) using 3:6 with linespoints pointtype 4 linecolor "#d55e00" title "stress, K_0 = 0.5", \
     of("stress", 2) using 3:6 with linespoints pointtype 5 linecolor "#d55e00" title "stress, K_0 = 2", \
     of("elastic", 2) using 3:6 with linespoints pointtype 7 linecolor "#009e73" title "elastic, any K_0"

set title "its part in cos 2θ, over Kirsch"
set yrange [0.4:1.7]
plot of("rollers", 0.5) using 3:7 with linespoints pointtype 6 linecolor "#0072b2" title "rollers, K_0 = 0.5", \
     of("rollers", 2) using 3:7 with linespoints pointtype 7 linecolor "#0072b2" title "rollers, K_0 = 2", \
     of("stress", 0.5) using 3:7 with linespoints pointtype 4 linecolor "#d55e00" title "stress, K_0 = 0.5", \
     of("stress", 2) using 3:7 with linespoints pointtype 5 linecolor "#d55e00" title "stress, K_0 = 2", \
     of("elastic", 2) using 3:7 with linespoints pointtype 7 linecolor "#009e73" title "elastic, any K_0"
unset multiplot
