#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What README.md and docs/tutorial.md show is what the program prints today.
#   page_figures.sh <project> <program voussoir> <folder of example programs> <scratch folder>
#
# - Every command of a ```sh or ```console block that calls voussoir is run, in the order of the page.
# - A block without a language is what the code block before it prints, line by line; `...` stands for
#   lines left out. A ```cpp block prints what examples/minimal.cpp prints (rules/readme: they are one).
# - Sentences and rows of tables with figures in them are written anew from run.json and
#   interaction.csv (`stands` below), and must stand on the page word for word.
#
# Tolerance: none but the digits printed, each of which must be the same. Seconds are not compared.
set -euo pipefail
export LC_ALL=C
root=$1 voussoir=$2 examples=$3 scratch=$4
failed=0 compared=0 commands=0
complain() {
  printf '%s\n' "$*" >&2
  failed=1
}

rm -rf "$scratch"
mkdir -p "$scratch/build/program"
ln -s "$voussoir" "$scratch/build/program/voussoir"
ln -s "$root/examples" "$scratch/examples"
cd "$scratch"

# ---- blocks ----------------------------------------------------------------------------------------
# split <page>: its code blocks as files <number>.<language>, <number>.output for those without one
split() {
  awk -v folder="$2" '
    /^```/ {
      if (file) { close(file); file = "" }
      else {
        language = substr($0, 4)
        file = sprintf("%s/%03d.%s", folder, ++count, language == "" ? "output" : language)
        printf "" > file
      }
      next
    }
    file { print > file }' "$1"
}
# plain: one blank between words, none at the end, `_ s` for seconds
plain() { sed -E 's/[ \t]+/ /g; s/ $//; s/[0-9.]+ s([ ,;)]|$)/_ s\1/g'; }
# differs <file shown> <file printed>: what is wrong with the former, or nothing
differs() {
  awk '
    NR == FNR { printed[++count] = $0; next }
    $0 == "..." { skips = 1; next }
    {
      ++at
      from = at
      while (skips && at < count && printed[at] != $0) ++at
      skips = 0
      if (at > count || printed[at] != $0) {
        print "  the page has  " $0
        print "  printed is    " (from > count ? "nothing more" : printed[from])
        wrong = 1
        exit
      }
    }
    END {
      if (!wrong && !skips && at < count)
        print "  printed is, behind the last line of the page,  " printed[at + 1]
    }' <(plain <"$2") <(plain <"$1")
}
for page in README.md docs/tutorial.md; do
  blocks=$(mktemp -d "$scratch/blocks.XXXXXX")
  split "$root/$page" "$blocks"
  : >printed
  for block in "$blocks"/*; do
    case $block in
    *.sh | *.console)
      : >printed
      while IFS= read -r command; do
        commands=$((commands + 1)) status=0
        bash -c "$command" </dev/null >>printed || status=$?
        [[ $status == 0 ]] || complain "$page: exit status $status of  $command"
      done < <(sed -E -e ':join' -e '/\\$/{N;s/\\\n//;bjoin' -e '}' -e 's/^\$ //' "$block" |
        grep -E '^[^ #]*voussoir ' | grep -v '^cmake ' || true)
      ;;
    *.cpp) "$examples/minimal" >printed ;;
    *.output)
      compared=$((compared + $(wc -l <"$block")))
      wrong=$(differs "$block" printed)
      [[ -z $wrong ]] || complain "$page:"$'\n'"$wrong"
      ;;
    esac
  done
done
[[ $commands -ge 5 && $compared -ge 30 ]] ||
  complain "only $commands commands and $compared lines of output were found: are blocks written in another way?"

# ---- tables and sentences --------------------------------------------------------------------------
stands() { # <page> <text>
  compared=$((compared + 1))
  if [[ -z $2 ]] || ! grep -qF -- "$2" "$root/$1"; then
    complain "$1 does not say what was computed:"$'\n'"  $2"
  fi
}
run() { # <folder> <input> <option>...: a run without words; rock may fall (6)
  "$voussoir" run "examples/paper/$2.toml" --out "$1" --quiet "${@:3}" || [[ $? == 6 ]]
}
# value <folder> <key>: of its run.json, where the key stands first
value() { sed -n "s/^ *\"$2\": \([-+.e0-9]*\),\{0,1\}\$/\1/p" "$1/run.json" | sed -n 1p; }
# compute <format> <expression>
compute() { awk "BEGIN { printf \"$1\", ${2//$'\n'/ } }"; }
# spread <format>: mean and standard deviation of the numbers, one a line
spread() {
  awk -v format="$1 ± $1" '{ s += $1; q[NR] = $1 }
    END { m = s / NR; for (i in q) d += (q[i] - m) ^ 2; printf format, m, sqrt(d / (NR - 1)) }'
}

page=docs/tutorial.md
for seed in 1 2 3 4 5; do
  run "seed$seed" tunnel --set model.seed=$seed
  stands $page "$(printf '| %d | %.2f | %.0f | %.0f | %.1f |' $seed "$(value "seed$seed" crown_mm)" \
    "$(value "seed$seed" largest_force_kN)" "$(value "seed$seed" largest_thrust_kN_per_m)" \
    "$(value "seed$seed" largest_moment_kNm_per_m)")"
done
# The edge fibre of a ring of thickness t [m]: N/t + 6M/t^2, from kN/m and kN m/m to MPa.
thrust=$(value seed1 largest_thrust_kN_per_m) moment=$(value seed1 largest_moment_kNm_per_m)
stands $page "N/t + 6M/t² = $(compute '%.1f + %.1f = %.0f MPa' \
  "$thrust / 100, 6 * $moment / 10, $thrust / 100 + 6 * $moment / 10")"
stands $page "The $(printf '%.0f' "$(value seed1 largest_force_kN)") kN bolt"
run lean tunnel --set "support.lining.thickness=5 cm" --set "support.bolts.spacing=18 deg"
thrust=$(value lean largest_thrust_kN_per_m) moment=$(value lean largest_moment_kNm_per_m)
stands $page "gives $(printf '%.2f mm, bolts up to %.0f kN, thrust up to %.0f kN/m and moment up to %.1f kN m/m' \
  "$(value lean crown_mm)" "$(value lean largest_force_kN)" "$thrust" "$moment")"
stands $page "stressed more: $(compute '%.1f + %.1f MPa' "$thrust / 50, 6 * $moment / 2.5")"
run elastic_ground tunnel --set boundary.sides=elastic --set boundary.base=elastic
stands $page "elastic ground, which adds $(compute '%.0f' "100 *
  ($(value elastic_ground largest_thrust_kN_per_m) / $(value seed1 largest_thrust_kN_per_m) - 1)") % to the thrust"
# Of the diagram that the page has computed: verdict and detached area of two tunnels without lining.
area() {
  awk -F, -v spacing="$1" '
    NR == 1 { for (k = 1; k <= NF; ++k) column[$k] = k }
    $1 == spacing && $2 == 0 { printf "%.1f", $column["detached_area_m2"] }' results/interaction.csv
}
stands $page "at 22.5° blocks of $(area 22.5) m² detach, and without bolts $(area none) m²"

page=README.md
# caption <example> <what it prints> <the same on the page, \1 in place of a group of the former>
caption() { stands $page "$("$examples/$1" | sed -nE "s/.*$2.*/$3/p")"; }
caption cavern_3d '\b([0-9]+)([0-9]{3}) blocks, ([0-9]+) lining nodes' '\1 \2 blocks, bolts and ribs (\3 lining nodes)'
caption rock_mass_3d '\b([0-9]+ blocks),' '\1 between'
caption rockfall '\b([0-9]+ blocks)\. Bare' 'The same \1 without support'
stands $page "$(value seed1 bodies) blocks, in equilibrium"
stands $page "| 662 kPa | $(compute '%.3f' "$(value seed1 vertical_stress_at_centre_kPa)") kPa |"
for seed in 1 2 3 4 5; do
  run "elastic$seed" unsupported --set "joint.friction=89 deg" --set model.seed=$seed
  run "lining$seed" tunnel --set "support.bolts.stiffness=1 kN/m" --set model.seed=$seed
  value "seed$seed" in_situ_out_of_balance_force_ratio >>in_situ
  value "lining$seed" mean_thrust_kN_per_m >>thrusts
  compute '%.9g\n' "($(value "elastic$seed" crown_mm) + $(value "elastic$seed" invert_mm) +
    $(value "elastic$seed" left_springing_mm) + $(value "elastic$seed" right_springing_mm)) / 4" >>walls
done
stands $page "worst block | 0 | $(sort -g in_situ | sed -n '$p' | xargs printf '%.0e') |"
stands $page "| $(spread %.2f <walls) mm (mean of crown, springings and invert; five realisations"
stands $page "| $(spread %.0f <thrusts) kN/m (five realisations"
run explicit tunnel --set run.method=explicit
run tight tunnel --set run.tolerance=1e-6
for folder in explicit seed1; do
  printf '| crown %.3f mm, thrust %.0f kN/m ' "$(value $folder crown_mm)" \
    "$(value $folder largest_thrust_kN_per_m)"
done >row
stands $page "$(<row)|"
stands $page "$(printf '| crown %.4f mm | crown %.4f mm |' "$(value tight crown_mm)" "$(value seed1 crown_mm)")"

echo "$commands commands, $compared lines, rows and sentences compared"
exit $failed
