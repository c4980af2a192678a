#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What a Latin hypercube is worth on tunnels: docs/sensitivity.md.
#   latin_table.sh <program voussoir> [DESIGNS] [THREADS]
#
# Two files: beds at fixed distances, which leave little to the seed of the joints, and three random
# sets, which leave much. Of each so many designs (20) of 50 points of a Latin hypercube and of 150
# independent ones, with other seeds for every design. The spread of the mean over the designs is
# how unsure it is, whatever an interval says of it; 20 designs tell it to a sixth.
set -euo pipefail
export LC_ALL=C
voussoir=$1 designs=${2:-20} threads=${3:-1}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

head='[model]
width = "30 m"
below_invert = "8 m"
[tunnel]
shape = "circle"
diameter = "6 m"
cover = "10 m"
facets = 36
[rock]
density = "2700 kg/m^3"
[stress]
K0 = {min = 0.6, mode = 1.0, max = 1.4}
[joint]
kn = {mean = "5 GPa/m", sd = "1 GPa/m", distribution = "lognormal"}
ks = "0.5 GPa/m"
friction = {mean = "32 deg", sd = "3 deg"}
[blocks]
min_inscribed_radius = "0.2 m"
[support.bolts]
length = "3 m"
spacing = "20 deg"
stiffness = "0.2 GN/m"
rupture_force = "200 kN"
[support.lining]
thickness = "10 cm"
E = "25 GPa"
interface = { kn = "1 GPa/m", friction = "30 deg" }
'
declare -A joints
joints[beds]='[[joint_set]]
dip = "20 deg"
dip_direction = "E"
spacing = "1 m"
spacing_law = "fixed"
[[joint_set]]
dip = "70 deg"
dip_direction = "W"
spacing = "1 m"
spacing_law = "fixed"
'
joints[random]='[[joint_set]]
dip = "75 deg"
dip_direction = "E"
sd = "5 deg"
intensity = "0.7 /m^2"
extent = "2 m"
[[joint_set]]
dip = "25 deg"
dip_direction = "E"
sd = "5 deg"
intensity = "0.7 /m^2"
extent = "2 m"
[[joint_set]]
dip = "25 deg"
dip_direction = "W"
sd = "5 deg"
intensity = "0.7 /m^2"
extent = "2 m"
'
# figures <realisations.csv> <rows>: means of crown and bolt force, how many have a value, median and
# largest crown
figures() {
  awk -F, -v rows="$2" '
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
    NR <= rows + 1 && $at["crown_convergence_mm"] != "nan" {
      ++n; c = $at["crown_convergence_mm"] + 0; s += c; b += $at["largest_bolt_force_kN"]
      for (k = n; k > 1 && v[k - 1] > c; --k) v[k] = v[k - 1]
      v[k] = c
    }
    END { print s / n, b / n, n, (v[int((n + 1) / 2)] + v[int(n / 2) + 1]) / 2, v[n] }' "$1"
}
for rock in beds random; do
  printf '%s%s' "$head" "${joints[$rock]}" > "$scratch/$rock.toml"
  for ((k = 0; k < designs; ++k)); do
    for sampling in latin random; do
      n=$([ $sampling = latin ] && echo 50 || echo 150)
      out="$scratch/$rock-$sampling-$k"
      "$voussoir" realisations "$scratch/$rock.toml" -n "$n" --sampling $sampling -j "$threads" -q \
        --set "model.seed=$((1 + 1000 * k))" --out "$out" || [ $? = 3 ]
      width=$(sed -n '/"crown convergence": {$/,/}/ s/.*"mean_\(low\|high\)_95": \(.*\),/\2/p' \
        "$out/realisations.json" | awk 'NR == 1 { low = $1 } NR == 2 { print $1 - low }')
      explained=$(sed -n '/explained_by_the_keys/,/}/ s/.*"crown convergence": \([^,]*\),*/\1/p' \
        "$out/realisations.json")
      echo "$rock $sampling $n $(figures "$out/realisations.csv" "$n") $width $explained"
      [ $sampling = random ] &&
        echo "$rock $sampling 50 $(figures "$out/realisations.csv" 50) nan nan"
      rm -rf "$out"
    done
  done
done > "$scratch/all"
# Spread over the designs, largest of all, mean width of the printed interval, mean share explained.
awk '
  { key = $1 " | " $2 " | " $3; if (!(key in n)) order[++keys] = key
    ++n[key]; c[key] += $4; cc[key] += $4 * $4; b[key] += $5; bb[key] += $5 * $5
    valued[key] += $6; d[key] += $7; dd[key] += $7 * $7
    if ($8 > most[key]) most[key] = $8
    w[key] += $9; e[key] += $10 }
  function spread(sum, squares, m) { return sqrt((squares - sum * sum / m) / (m - 1)) }
  END {
    print "| rock | sampling | realisations | with a value | crown [mm] | its spread | spread of its median | largest of all [mm] | bolt force [kN] | its spread | interval of the crown printed | explained by the keys |"
    print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
    for (k = 1; k <= keys; ++k) {
      key = order[k]; m = n[key]
      printf "| %s | %.1f | %.4f | %.4f | %.4f | %.2f | %.2f | %.3f | %.4f | %.2f |\n", key,
        valued[key] / m, c[key] / m, spread(c[key], cc[key], m), spread(d[key], dd[key], m),
        most[key], b[key] / m, spread(b[key], bb[key], m), w[key] / m, e[key] / m
    }
  }' "$scratch/all"
