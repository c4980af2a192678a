# SPDX-License-Identifier: MIT
# Draws a table of failure_table: area that comes off by every solution procedure against that of
# all blocks in motion, coloured by the verdict of its first run. Rings: what its runs do not agree
# on, with bars over all of them. Crosses: a verdict that is another, of those that are decided.
#   gnuplot -e "table='docs/data/failure_reference.csv'; picture='failure_cases.svg'" bench/failure_table.gp
set datafile separator ","
set terminal svg size 1200,430 font "Helvetica,13" background "white"
set output picture
set multiplot layout 1,3 title "Area that comes off unsupported tunnels that nobody picked [m²]: each procedure against all blocks in motion"
set logscale xy
set xrange [0.06:300]
set yrange [0.06:300]
set format "%g"
set xlabel "all blocks in motion, first run; bars: all runs"
set key top left Left reverse samplen 1
# Nothing fallen is drawn at the edge.
shown(area) = area > 0.07 ? area : 0.07
is_in(verdict, area, wanted) = verdict eq wanted ? shown(area) : NaN
varied = "damping_03 damping_07 half_step half_rate limit_x3 fibres"
area(run) = strcol(run) eq "-" ? column("reference_m2") : column(run."_m2")
is_other(run) = strcol(run) ne "-" && strcol(run) ne strcol("reference")
least(k) = k == 0 ? column("reference_m2") : area(word(varied, k)) < least(k - 1) ? area(word(varied, k)) : least(k - 1)
most(k) = k == 0 ? column("reference_m2") : area(word(varied, k)) > most(k - 1) ? area(word(varied, k)) : most(k - 1)
others(k) = k == 0 ? 0 : is_other(word(varied, k)) + others(k - 1)
# As RockfallRange::slivers has it; of a collapse the verdict alone counts.
is_marginal(k) = others(6) > 0 || (strcol("reference") ne "collapse" && most(6) - least(6) > 0.1 * most(6))
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
    table using (is_marginal(0) ? shown(column("reference_m2")) : NaN):(shown(column(m."_m2"))):(shown(least(6))):(shown(most(6))) \
      with xerrorbars pt 6 ps 1.6 lw 1.3 lc rgb "#6a1b9a" title "marginal", \
    table using (strcol(m) ne strcol("reference") && !is_marginal(0) ? shown(column("reference_m2")) : NaN):(shown(column(m."_m2"))) \
      with points pt 2 ps 1.6 lw 2 lc rgb "black" title "decided, another verdict"
}
unset multiplot
