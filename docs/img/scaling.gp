# SPDX-License-Identifier: MIT
# docs/img/scaling.png from docs/img/scaling.csv:  cd docs/img && gnuplot scaling.gp
set terminal pngcairo size 1200,520 font "sans,12"
set output "scaling.png"
set datafile separator ","
set multiplot layout 1,2
set logscale xy
set key top left Left reverse samplen 2
set grid
set xlabel "bodies"
set ylabel "processor time [s]"
set format xy "10^{%L}"
rows(space, what) = sprintf("< grep '^%s,%s,' scaling.csv", space, what)
set title "2-D: joints to equilibrium"
set xrange [3e3:2e6]
set yrange [2e-5:1e4]
plot rows("planar", "before") using 3:4 with linespoints lw 2 pt 6 title "before", \
     rows("planar", "now") using 3:4 with linespoints lw 2 pt 7 title "now", \
     rows("planar", "rock") using 3:4 with linespoints lw 1 pt 4 title "of which rock and supports", \
     rows("planar", "product") using 3:4 with linespoints lw 1 dt 2 pt 1 title "floor: one product with K"
set title "3-D: equilibrium of the supported tunnel"
set xrange [1e3:2e5]
plot rows("spatial", "before") using 3:4 with linespoints lw 2 pt 6 title "before", \
     rows("spatial", "now") using 3:4 with linespoints lw 2 pt 7 title "now", \
     rows("spatial", "factor") using 3:4 with linespoints lw 1 pt 4 title "a factor alone, now", \
     rows("spatial", "product") using 3:4 with linespoints lw 1 dt 2 pt 1 title "floor: one product with K"
unset multiplot
