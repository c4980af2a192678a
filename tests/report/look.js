// SPDX-License-Identifier: MIT
// What tests/report/run does to a report in the browser. Each statement is a line of the page, which
// the browser is then asked for: "look: holds ..." or "look: fails ...".
(function () {
  "use strict";
  var found = [];
  function claim(holds, what) { found.push("look: " + (holds ? "holds " : "fails ") + what); }
  function all(selector) { return Array.prototype.slice.call(document.querySelectorAll(selector)); }
  function point(x, y) {
    var target = document.elementFromPoint(x, y) || document.body;
    target.dispatchEvent(new PointerEvent("pointermove", { bubbles: true, clientX: x, clientY: y }));
    return target;
  }
  try {
    var page = document.documentElement, says = document.getElementById("says");
    claim(page.scrollWidth <= page.clientWidth, "nothing sticks out: " + page.scrollWidth + " px in " + page.clientWidth);
    all("a[href]").forEach(function (link) {
      var target = document.getElementById(link.getAttribute("href").slice(1));
      link.click();
      claim(target !== null, "the target of " + link.textContent);
      claim(target !== null && Math.abs(target.getBoundingClientRect().top) < window.innerHeight, "the link leads to " + link.textContent);
    });
    all("figure svg").forEach(function (picture) {
      var box = picture.getBoundingClientRect();
      claim(box.width > 250 && box.height > 100, "a picture is seen: " + box.width + " x " + box.height);
    });
    // Every kind of part that speaks, where it is seen: its middle is pointed at.
    var kinds = {};
    all("g.spots [data-says]").forEach(function (spot) {
      var kind = spot.getAttribute("data-says").split(/[ \n]/)[0];
      (kinds[kind] = kinds[kind] || []).push(spot);
    });
    Object.keys(kinds).forEach(function (kind) {
      var told = 0, tried = kinds[kind].slice(0, 60);
      tried.forEach(function (spot) {
        if (spot.closest("[hidden]")) return;  // a stage that is not shown
        spot.scrollIntoView({ block: "center" });
        var at = spot.getPointAtLength(0.5 * spot.getTotalLength()), matrix = spot.getScreenCTM();
        var seen = new DOMPoint(at.x, at.y).matrixTransform(matrix);
        point(seen.x, seen.y);
        if (says.style.display === "block" && says.textContent.indexOf(kind) === 0) {
          told += 1;
          var box = says.getBoundingClientRect();
          if (box.right > window.innerWidth + 1 || box.bottom > window.innerHeight + 1) claim(false, "what is told of " + kind + " is in the window");
        }
      });
      claim(told > 0, kind + " tells its values (" + told + " of " + tried.length + " that were pointed at)");
    });
    if (Object.keys(kinds).length > 0) {
      point(2, 2);
      claim(says.style.display === "none", "off the picture nothing is told");
    }
    // The slider shows one stage at a time.
    all(".stages").forEach(function (stages) {
      var slider = stages.querySelector(".slider input"), figures = stages.querySelectorAll("figure");
      claim(slider !== null && Number(slider.max) === figures.length - 1, "a slider over " + figures.length + " stages");
      for (var k = figures.length; k-- > 0;) {
        slider.value = k;
        slider.dispatchEvent(new Event("input"));
        var seen = Array.prototype.filter.call(figures, function (figure) { return figure.getBoundingClientRect().height > 0; });
        claim(seen.length === 1 && seen[0] === figures[k], "stage " + k + " alone is seen");
      }
      slider.value = slider.max;
      slider.dispatchEvent(new Event("input"));
    });
    // A design of a diagram leads to its row.
    var designs = all("#diagram [data-says]");
    designs.slice(0, 40).forEach(function (design) {
      design.dispatchEvent(new MouseEvent("click", { bubbles: true }));
      var rows = all("#diagram tr.chosen"), value = design.getAttribute("data-says").match(/convergence ([0-9.]+) mm/);
      claim(rows.length === 1 && (!value || rows[0].textContent.indexOf(value[1]) >= 0), "a click on " + design.getAttribute("data-says").split("\n")[0] + " shows its row");
    });
    // Layers are switched off and on.
    all(".layers input").forEach(function (box) {
      var figure = box.closest("figure"), name = box.parentNode.textContent;
      var layers = Array.prototype.filter.call(figure.querySelectorAll("g[data-layer]"), function (layer) {
        return layer.getAttribute("data-layer") === name;
      });
      box.click();
      claim(layers.some(function (layer) { return getComputedStyle(layer).display === "none"; }), "layer " + name + " is switched off");
      box.click();
      claim(layers.every(function (layer) { return getComputedStyle(layer).display !== "none"; }), "layer " + name + " is switched on");
    });
    found.push("look: done");
  } catch (error) {
    found.push("look: fails by an error: " + error);
  }
  var list = document.createElement("pre");
  list.textContent = "\n" + found.join("\n") + "\n";
  document.body.appendChild(list);
})();
