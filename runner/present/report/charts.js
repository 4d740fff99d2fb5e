// Charts from the report's data, drawn by Chart.js.
"use strict";

const kFaint = { record: "70", band: "2e" };  // opacity of a colour, in hex
const kOnTop = { reference: 0, mean: 2, record: 3, band: 4 };

const kInk = "#1a1a1a", kAxis = "#444444", kGrid = "#e8e8e8";

function shownNumber(value) {
  return String(Number(value.toPrecision(4)));
}

function axisTitle(axis) {
  return axis.unit === "" || axis.unit === "-" ? axis.name : `${axis.name} (${axis.unit})`;
}

function quantity(axis, value) {
  return `${axis.name}: ${shownNumber(value)}${axis.unit === "-" ? "" : " " + axis.unit}`;
}

// A gap is a point without a place.
function points(line) {
  return line.x.map((x, i) => ({ x: x === null ? NaN : x, y: line.y[i] === null ? NaN : line.y[i] }));
}

function colourOf(block, line) {
  return line.group < block.groups.length ? "#" + block.groups[line.group].colour : kInk;
}

function dashOf(group) {
  return (group.dash.match(/\d+/g) || []).map(Number);
}

// Chart.js sorts nothing here and takes nothing for sorted: a pile that moves up and down draws loops.
function datasetOf(block, line) {
  const colour = colourOf(block, line);
  const dataset = {
    line, data: points(line), showLine: true, order: kOnTop[line.kind], pointRadius: 0, pointHoverRadius: 4,
    borderColor: colour, backgroundColor: colour, borderWidth: 2.5, borderJoinStyle: "round",
  };
  if (line.kind === "record") Object.assign(dataset, { borderColor: colour + kFaint.record, borderWidth: 1 });
  if (line.kind === "band") {
    Object.assign(dataset, { fill: "shape", backgroundColor: colour + kFaint.band, borderWidth: 0, pointHoverRadius: 0 });
  }
  if (line.kind === "mean") dataset.borderDash = dashOf(block.groups[line.group]);
  if (line.kind === "reference") {
    Object.assign(dataset, { showLine: false, pointStyle: "rectRot", pointRadius: 7, pointHoverRadius: 9,
                             borderColor: "#ffffff", borderWidth: 1.5 });
  }
  return dataset;
}

// The tolerances of a reference: a stroke through each point.
function toleranceOf(block, line) {
  const along = block.downwards ? "x" : "y";
  const data = [];
  points(line).forEach((point, i) => {
    for (const side of [-1, 1]) data.push({ ...point, [along]: point[along] + side * line.tolerance[i] });
    data.push({ x: NaN, y: NaN });
  });
  return { line: { ...line, kind: "tolerance" }, data, showLine: true, order: 1, pointRadius: 0, pointHoverRadius: 0,
           borderColor: colourOf(block, line), borderWidth: 2 };
}

// The nearest point that has something to say.
Chart.Interaction.modes.nearestPoint = (chart, event) => {
  let found = null, least = Infinity;
  chart.data.datasets.forEach((dataset, datasetIndex) => {
    if (!chart.isDatasetVisible(datasetIndex) || dataset.line.kind === "band" || dataset.line.kind === "tolerance") return;
    chart.getDatasetMeta(datasetIndex).data.forEach((element, index) => {
      const distance = Math.hypot(element.x - event.x, element.y - event.y);
      if (distance < least) {
        least = distance;
        found = { element, datasetIndex, index };
      }
    });
  });
  return found ? [found] : [];
};

function intervalText(block, line, index) {
  const band = block.lines.find((one) => one.kind === "band" && one.group === line.group);
  if (line.kind !== "mean" || !band) return "";
  const low = band.x[index], high = band.x[band.x.length - 1 - index];
  return ` (${shownNumber(low)} to ${shownNumber(high)})`;
}

function tooltipOf(block) {
  return {
    displayColors: false,
    callbacks: {
      title: ([item]) => block.groups[item.dataset.line.group]?.label || "reference",
      label: (item) => {
        const line = item.dataset.line;
        const value = block.downwards ? item.parsed.x : item.parsed.y;
        const tolerance = line.kind === "reference" ? ` ± ${shownNumber(line.tolerance[item.dataIndex])}` : "";
        const texts = [quantity(block.downwards ? block.x : block.y, value) + tolerance +
                       intervalText(block, line, item.dataIndex),
                       block.downwards ? quantity(block.y, item.parsed.y) : quantity(block.x, item.parsed.x)];
        return line.label === "" ? texts : [line.label, ...texts];
      },
    },
  };
}

// Chart.js writes numbers below a millionth with every digit that their spacing has.
function tickText(value, index, ticks) {
  const largest = Math.max(...ticks.map((tick) => Math.abs(tick.value)));
  if (largest >= 1e-4 && largest < 1e7) return Chart.Ticks.formatters.numeric.call(this, value, index, ticks);
  return value === 0 ? "0" : String(Number(value.toPrecision(3)).toExponential());
}

function scaleOf(axis, more) {
  return {
    type: "linear", title: { display: true, text: axisTitle(axis), color: kInk, font: { size: 14 } },
    ticks: { color: kAxis, callback: tickText }, grid: { color: kGrid, borderColor: "#8c8c8c" }, ...more,
  };
}

// A band may reach below nothing where no curve does; depth and resistance begin at 0 then.
function leastOf(block, axis) {
  const values = block.lines.filter((line) => line.kind !== "band").flatMap((line) => line[axis]);
  return block.downwards && values.every((value) => value === null || value >= 0) ? 0 : undefined;
}

function drawChart(canvas, block) {
  const datasets = block.lines.map((line) => datasetOf(block, line));
  for (const line of block.lines) if (line.kind === "reference") datasets.push(toleranceOf(block, line));
  return new Chart(canvas, {
    type: "scatter",
    data: { datasets },
    options: {
      animation: false, responsive: true, maintainAspectRatio: false,
      devicePixelRatio: Math.max(2, window.devicePixelRatio),
      interaction: { mode: "nearestPoint", intersect: false },
      plugins: { legend: { display: false }, tooltip: tooltipOf(block) },
      scales: {
        x: scaleOf(block.x, { position: block.downwards ? "top" : "bottom", min: leastOf(block, "x") }),
        y: scaleOf(block.y, { reverse: block.downwards, min: leastOf(block, "y") }),
      },
    },
  });
}

function drawBars(canvas, block) {
  return new Chart(canvas, {
    type: "bar",
    data: { labels: block.labels, datasets: [{ data: block.values, backgroundColor: "#0072b2", maxBarThickness: 22 }] },
    options: {
      animation: false, responsive: true, maintainAspectRatio: false, indexAxis: "y",
      devicePixelRatio: Math.max(2, window.devicePixelRatio),
      plugins: { legend: { display: false },
                 tooltip: { displayColors: false, callbacks: { label: (item) => quantity(block.x, item.parsed.x) } } },
      scales: { x: scaleOf(block.x, { beginAtZero: true }), y: { ticks: { color: kInk }, grid: { display: false } } },
    },
  });
}
