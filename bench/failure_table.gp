# SPDX-License-Identifier: MIT
# Draws a table of failure_table: fallen area by every solution procedure against that of all blocks
# in motion, coloured by the verdict of the latter, crosses where the verdict is another.
#   gnuplot -e "table='docs/data/failure_cases.csv'; picture='failure_cases.svg'" bench/failure_table.gp
set datafile separator ","
set terminal svg size 1200,430 font "Helvetica,13" background "white"
set output picture
set multiplot layout 1,3 title "Fallen area of unsupported tunnels that nobody picked [m²]: each procedure against all blocks in slow motion"
set logscale xy
set xrange [0.06:300]
set yrange [0.06:300]
set format "%g"
set xlabel "all blocks in motion"
set key top left Left reverse samplen 1
# Nothing fallen is drawn at the edge.
shown(area) = area > 0.07 ? area : 0.07
is_in(verdict, area, wanted) = verdict eq wanted ? shown(area) : NaN
names = "two_level relaxation explicit"
titles = "TwoLevel Relaxation Explicit"
do for [k = 1:3] {
  m = word(names, k)
  set ylabel word(titles, k)
  plot x notitle lc rgb "#999999" dt 2, \
    table using (is_in(strcol("reference"), column("reference_m2"), "stable")):(shown(column(m."_m2"))) \
      with points pt 7 ps 0.6 lc rgb "#15803d" title "stable", \
    table using (is_in(strcol("reference"), column("reference_m2"), "rockfall")):(shown(column(m."_m2"))) \
      with points pt 7 ps 0.6 lc rgb "#b45309" title "stable after rockfall", \
    table using (is_in(strcol("reference"), column("reference_m2"), "collapse")):(shown(column(m."_m2"))) \
      with points pt 7 ps 0.6 lc rgb "#b91c1c" title "collapse (ended at its limit)", \
    table using (strcol(m) ne strcol("reference") ? shown(column("reference_m2")) : NaN):(shown(column(m."_m2"))) \
      with points pt 2 ps 1.6 lw 2 lc rgb "black" title "another verdict"
}
unset multiplot
