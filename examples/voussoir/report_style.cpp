// SPDX-License-Identifier: MIT
// How reports look, on screen, in the dark and on paper, and what a pointer does in them.
// Everything is read without the script. Neither `<` nor `&` stands in them: the page is XML, too.
#include "report_page.hpp"

namespace voussoir::program::html {

const std::string_view style = R"css(
:root {
  --ink: #1a1f24; --soft: #5b6670; --paper: #ffffff; --ground: #f3f5f7; --rule: #d6dce1;
  --accent: #1f4e79; --good: #1b6e3c; --doubtful: #945800; --bad: #a8201a;
  --good-ground: #e9f5ed; --doubtful-ground: #fdf3e1; --bad-ground: #fcebea;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ink: #e4e8ec; --soft: #9aa7b3; --paper: #1b2127; --ground: #12161a; --rule: #37424c;
    --accent: #8dbde8; --good: #76cf96; --doubtful: #eab765; --bad: #f09489;
    --good-ground: #15291d; --doubtful-ground: #2f2614; --bad-ground: #351b19;
  }
}
* { box-sizing: border-box; }
html { scroll-padding-top: 3.2rem; }
body {
  margin: 0 auto; padding: 0 1.25rem 3rem; max-width: 62rem;
  font: 1rem/1.55 "Segoe UI", Roboto, "Helvetica Neue", "Noto Sans", "DejaVu Sans", Arial, sans-serif;
  color: var(--ink); background: var(--ground); font-variant-numeric: tabular-nums;
}
header { padding: 2.2rem 0 1rem; }
h1 { margin: 0; font-size: 1.9rem; line-height: 1.2; font-weight: 650; overflow-wrap: anywhere; }
.subtitle { margin: .35rem 0 0; color: var(--soft); overflow-wrap: anywhere; }
section {
  margin: 1.1rem 0; padding: 1.3rem 1.5rem 1.4rem; background: var(--paper);
  border: 1px solid var(--rule); border-radius: .5rem;
}
h2 { margin: 0 0 .8rem; font-size: 1.25rem; line-height: 1.25; font-weight: 650; }
h3 { margin: 1.6rem 0 .5rem; font-size: 1.02rem; font-weight: 650; }
p { margin: .55rem 0; max-width: 46rem; overflow-wrap: anywhere; }
ul { margin: .55rem 0; padding-left: 1.2rem; max-width: 46rem; }
li { margin: .25rem 0; overflow-wrap: anywhere; }
a { color: var(--accent); }
.verdict { border-left: .45rem solid var(--soft); }
.verdict.good { border-left-color: var(--good); }
.verdict.doubtful { border-left-color: var(--doubtful); }
.verdict.bad { border-left-color: var(--bad); }
.word { font-size: 1.45rem; margin-bottom: .3rem; }
.verdict.good .word { color: var(--good); }
.verdict.doubtful .word { color: var(--doubtful); }
.verdict.bad .word { color: var(--bad); }
.sentence { font-size: 1.1rem; max-width: none; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(13rem, 1fr)); gap: .9rem; margin-top: 1.1rem; }
.card { padding: .75rem 1rem .8rem; border: 1px solid var(--rule); border-top: .2rem solid var(--soft); border-radius: .35rem; }
.card.good { border-top-color: var(--good); }
.card.doubtful { border-top-color: var(--doubtful); background: var(--doubtful-ground); }
.card.bad { border-top-color: var(--bad); background: var(--bad-ground); }
.card span { display: block; }
.card .name { font-size: .85rem; color: var(--soft); }
.card .value { font-size: 1.75rem; line-height: 1.25; font-weight: 650; }
.card .value .unit { display: inline; font-size: 1rem; font-weight: 400; }
.card .remark { font-size: .9rem; line-height: 1.4; }
nav { position: sticky; top: 0; z-index: 5; background: var(--ground); border-bottom: 1px solid var(--rule); }
nav ol { display: flex; flex-wrap: wrap; gap: .1rem 1rem; margin: 0; padding: .5rem 0; list-style: none; font-size: .86rem; }
nav li { margin: 0; }
nav a { text-decoration: none; }
nav a:hover { text-decoration: underline; }
.wide { overflow-x: auto; margin: .9rem 0; }
table { border-collapse: collapse; font-size: .92rem; line-height: 1.4; min-width: 50%; }
caption { text-align: left; padding: 0 0 .35rem; font-weight: 650; white-space: nowrap; }
th, td { padding: .32rem .65rem; text-align: right; vertical-align: top; border-bottom: 1px solid var(--rule); }
th:first-child, td:first-child { padding-left: .3rem; }
th { vertical-align: bottom; font-weight: 600; border-bottom: 2px solid var(--soft); }
th .unit { display: block; font-weight: 400; color: var(--soft); font-size: .85em; }
.text { text-align: left; }
td.text { overflow-wrap: break-word; }
td.name { white-space: nowrap; }
tr.group th { text-align: left; padding-top: .9rem; border-bottom: 1px solid var(--soft); }
tr.chosen td { background: var(--doubtful-ground); font-weight: 600; }
#diagram [data-says] { cursor: pointer; }
tr.good td:last-child { color: var(--good); }
tr.doubtful td { background: var(--doubtful-ground); }
tr.doubtful td:last-child { color: var(--doubtful); font-weight: 600; }
tr.bad td { background: var(--bad-ground); }
tr.bad td:last-child { color: var(--bad); font-weight: 600; }
figure { margin: 1rem 0; }
figure .sheet { background: #ffffff; border: 1px solid var(--rule); border-radius: .3rem; padding: .4rem; }
figure svg { display: block; width: 100%; height: auto; }
.slider { display: flex; flex-wrap: wrap; align-items: center; gap: .3rem .8rem; margin: .2rem 0 .4rem; }
.slider input { flex: 1 1 12rem; max-width: 26rem; accent-color: var(--accent); }
.slider output { font-weight: 650; }
.stages figure[hidden] { display: none; }
summary { cursor: pointer; color: var(--accent); }
figcaption { margin-top: .45rem; font-size: .9rem; color: var(--soft); max-width: 52rem; }
.layers { display: none; flex-wrap: wrap; gap: .2rem 1.1rem; margin: .3rem 0 .5rem; font-size: .88rem; }
.scripted .layers { display: flex; }
.layers label { cursor: pointer; }
.layers input { accent-color: var(--accent); vertical-align: -.1em; margin: 0 .3em 0 0; }
.spots .at { stroke: #d40078; stroke-opacity: .65; }
.spots path:not([stroke-width]) { stroke-width: 2.4; }
#says {
  position: fixed; z-index: 9; display: none; max-width: 22rem; padding: .35rem .65rem; white-space: pre-line;
  font-size: .88rem; line-height: 1.4; color: #fff; background: #1a1f24; border: 1px solid #5b6670; border-radius: .3rem; pointer-events: none;
}
code { font: .9em ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
pre { margin: .7rem 0; padding: .7rem .9rem; background: var(--ground); border: 1px solid var(--rule); border-radius: .3rem; white-space: pre-wrap; }
footer { margin-top: 1.5rem; font-size: .85rem; color: var(--soft); overflow-wrap: anywhere; }
@page { size: A4; margin: 16mm 15mm 18mm; }
@media print {
  :root {
    --ink: #000; --soft: #444; --paper: #fff; --ground: #fff; --rule: #bbb; --accent: #000;
    --good: #14572f; --doubtful: #7a4a00; --bad: #8d1a15;
    --good-ground: #fff; --doubtful-ground: #f6f0e4; --bad-ground: #f7eceb;
  }
  html { font-size: 9.6pt; }
  body { max-width: none; padding: 0; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  header { padding: 0 0 .6rem; }
  nav, .layers, .scripted .layers, .slider, #says, .stages details { display: none; }
  .stages figure, .stages figure[hidden] { display: none; }
  .stages figure:last-of-type { display: block; }
  section { margin: 0 0 1.2rem; padding: 0; border: 0; border-radius: 0; }
  section.verdict { padding-left: 1rem; border-left: .45rem solid var(--soft); }
  h2, h3, caption { break-after: avoid; }
  h2 { border-bottom: 1px solid var(--rule); padding-bottom: .2rem; }
  .word { border: 0; }
  figure, tr, .card { break-inside: avoid; }
  tr.group { break-after: avoid; }
  figure .sheet { border: 0; padding: 0; }
  figure svg { max-height: 235mm; }
  .wide { overflow: visible; }
  thead { display: table-header-group; }
  a { color: inherit; text-decoration: none; }
}
)css";

const std::string_view script = R"js(
(function () {
  "use strict";
  var page = document.documentElement;
  page.classList.add("scripted");
  // Layers of a picture, each with a box to switch it off.
  document.querySelectorAll("figure[data-layers]").forEach(function (figure) {
    var row = figure.querySelector(".layers");
    figure.querySelectorAll("g[data-layer]").forEach(function (layer) {
      if (layer.querySelector("g[data-layer]")) return;  // its parts have boxes of their own
      var label = document.createElement("label"), box = document.createElement("input");
      box.type = "checkbox";
      box.checked = true;
      box.addEventListener("change", function () { layer.style.display = box.checked ? "" : "none"; });
      label.appendChild(box);
      label.appendChild(document.createTextNode(layer.getAttribute("data-layer")));
      row.appendChild(label);
    });
  });
  // One picture of a stage at a time, the last at first.
  document.querySelectorAll(".stages").forEach(function (stages) {
    var details = stages.querySelector("details"), last = stages.querySelector("figure");
    var figures = Array.prototype.slice.call(details.querySelectorAll("figure"));
    var row = document.createElement("label"), slider = document.createElement("input");
    var name = document.createElement("output");
    row.className = "slider";
    slider.type = "range";
    slider.min = 0;
    slider.max = slider.value = figures.length;
    row.append("Stages", slider, name);
    figures.forEach(function (figure) { stages.insertBefore(figure, last); });
    stages.insertBefore(row, stages.firstChild);
    details.remove();
    figures.push(last);
    function show() {
      figures.forEach(function (figure, k) { figure.hidden = k !== Number(slider.value); });
      var chosen = figures[Number(slider.value)];
      name.textContent = chosen === last ? stages.getAttribute("data-last") : chosen.querySelector("figcaption").textContent;
    }
    slider.addEventListener("input", show);
    show();
  });
  // What a place in a picture says, beside the pointer at once; without this the browser waits.
  var says = document.createElement("div"), at = null;
  says.id = "says";
  document.body.appendChild(says);
  document.querySelectorAll("g.spots title").forEach(function (title) {
    title.parentNode.setAttribute("data-says", title.textContent);
    title.remove();
  });
  function leave() {
    if (at) at.classList.remove("at");
    at = null;
    says.style.display = "none";
  }
  function point(event) {
    var spot = event.target.closest ? event.target.closest("[data-says]") : null;
    if (!spot) return leave();
    if (spot !== at) {
      leave();
      at = spot;
      at.classList.add("at");
      says.textContent = spot.getAttribute("data-says");
      says.style.display = "block";
    }
    var right = page.clientWidth - says.offsetWidth - 8, low = page.clientHeight - says.offsetHeight - 8;
    says.style.left = Math.max(0, Math.min(event.clientX + 16, right)) + "px";
    says.style.top = Math.max(0, Math.min(event.clientY + 18, low)) + "px";
  }
  // A design of a diagram leads to its row: both have spacing and thickness in front.
  function numbers(text) { return (text.match(/[0-9.]+/g) || []).join(" "); }
  document.addEventListener("click", function (event) {
    var spot = event.target.closest ? event.target.closest("#diagram [data-says]") : null;
    if (!spot) return;
    var wanted = numbers(spot.getAttribute("data-says").split("\n")[0].replace("no lining", "lining 0"));
    document.querySelectorAll("#diagram tbody tr").forEach(function (row) {
      var is_it = numbers(row.cells[0].textContent + " " + row.cells[1].textContent) === wanted;
      row.classList.toggle("chosen", is_it);
      if (is_it) row.scrollIntoView({ block: "center" });
    });
  });
  document.addEventListener("pointermove", point);
  document.addEventListener("pointerdown", point);
  document.addEventListener("pointerleave", leave);
})();
)js";

}  // namespace voussoir::program::html
