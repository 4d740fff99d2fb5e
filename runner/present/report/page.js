// The page from its data. Whatever comes from a study becomes text, never markup.
"use strict";

function element(tag, properties = {}, children = []) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "text") made.textContent = value;
    else if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

function say(words) {
  const status = document.getElementById("status");
  status.textContent = words;
  window.clearTimeout(say.timer);
  say.timer = window.setTimeout(() => { status.textContent = ""; }, 4000);
}

// A page from a file may have no clipboard of its own; a selected text can be copied everywhere.
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = element("textarea", { value: text, readOnly: true, "aria-hidden": "true" });
    const before = document.activeElement;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    before?.focus();
    return done;
  }
}

function copyButton(what, csv) {
  const button = element("button", { type: "button", className: "copy", text: "Copy as CSV",
                                     ariaLabel: `Copy as CSV: ${what}` });
  button.addEventListener("click", async () => {
    const text = csv();
    const rows = text.split("\n").length - 2;
    say(await copy(text) ? `${rows} rows copied` : "The browser did not allow to copy");
  });
  return button;
}

function csvField(value) {
  const text = value === null ? "" : String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function csvOf(rows) {
  return rows.map((row) => row.map(csvField).join(",") + "\n").join("");
}

function headingOf(axis) {
  return axis.unit === "" ? axis.name : `${axis.name}[${axis.unit}]`;
}

function csvOfChart(block) {
  const rows = [["case", "line", "kind", headingOf(block.x), headingOf(block.y), "tolerance"]];
  for (const line of block.lines) {
    const group = block.groups[line.group]?.label ?? "";
    line.x.forEach((x, i) => rows.push([group, line.label, line.kind, x, line.y[i], line.tolerance[i] ?? null]));
  }
  return csvOf(rows);
}

function cellOf(block, column, row) {
  const text = column.cells[row];
  const inside = column.toned ? [element("span", { className: block.tones[row], text })] : [text];
  const first = column === block.columns.find((one) => !one.toned);
  const cell = element(first ? "th" : "td", {}, inside);
  if (first) cell.scope = "row";
  cell.className = text.length > 40 ? "long" : column.numbers ? "number" : "short";
  return cell;
}

function tableOf(block) {
  const heads = block.columns.map((column) => {
    const head = element("th", { scope: "col", className: column.numbers ? "number" : "" }, [column.name]);
    if (column.unit !== "") head.append(element("span", { className: "unit", text: column.unit }));
    return head;
  });
  const rows = [];
  for (let row = 0; row < block.rows; ++row)
    rows.push(element("tr", {}, block.columns.map((column) => cellOf(block, column, row))));
  return element("table", {}, [element("caption", { text: block.caption }),
                               element("thead", {}, [element("tr", {}, heads)]), element("tbody", {}, rows)]);
}

function notesOf(block) {
  return block.notes.map((text) => element("p", { className: "note", text }));
}

const kMostUpright = 13;  // columns that fit on an upright page

const draw = {
  text: (block) => element("ul", { className: "block notes" }, block.paragraphs.map((text) => element("li", { text }))),

  table: (block) => {
    const size = block.columns.length > kMostUpright ? "scroll wide" : "scroll";
    const inside = [element("div", { className: size }, [tableOf(block)]),
                    element("div", { className: "bar" }, [copyButton(block.caption, () => block.csv)]), ...notesOf(block)];
    if (!block.folded) return element("div", { className: "block" }, inside);
    return element("details", { className: "block" },
                   [element("summary", { text: `${block.caption} (${block.rows} rows)` }), ...inside]);
  },

  chart: (block) => {
    const canvas = element("canvas", { role: "img", ariaLabel: `${block.title}. ${block.note} The numbers follow below.` });
    const frame = element("div", { className: "chart" }, [canvas]);
    frame.style.height = block.downwards ? "42rem" : "26rem";
    const legend = element("div", { className: "legend", role: "group", ariaLabel: "Lines" });
    const values = element("details", { className: "values" }, [element("summary", { text: "The chart in numbers" })]);
    values.addEventListener("toggle", () => values.append(draw.table(block.values)), { once: true });
    const figure = element("figure", { className: "block" }, [
      element("div", { className: "bar" }, [element("h3", { text: block.title }),
                                            copyButton(block.title, () => csvOfChart(block))]),
      element("p", { className: "note", text: block.note }), legend,
      element("div", { className: "paper" }, [frame]), values]);
    later.push(() => addLegend(legend, block, drawChart(canvas, block)));
    return figure;
  },

  bars: (block) => {
    const canvas = element("canvas", { role: "img", ariaLabel: `${block.title}. The numbers are in the table above.` });
    const frame = element("div", { className: "chart" }, [canvas]);
    frame.style.height = `${5 + 1.6 * block.labels.length}rem`;
    later.push(() => drawBars(canvas, block));
    const csv = () => csvOf([["run", headingOf(block.x)], ...block.labels.map((label, i) => [label, block.values[i]])]);
    return element("figure", { className: "block" }, [
      element("div", { className: "bar" }, [element("h3", { text: block.title }), copyButton(block.title, csv)]),
      element("div", { className: "paper" }, [frame])]);
  },

  picture: (block) => element("figure", { className: "block" }, [
    element("div", { className: "bar" }, [element("h3", { text: block.name })]),
    element("div", { className: "paper" }, [
      element("img", { className: "picture", alt: `Picture ${block.name} of the study`,
                       src: `data:image/svg+xml;base64,${block.svg}` })])]),

  log: (block) => element("div", { className: "block" }, [
    element("h3", { text: block.title }),
    element("p", {}, [element("span", { className: "bad", text: block.outcome }), ` ${block.reason}`]),
    element("p", { className: "note", text: `Last lines of ${block.where}` }), element("pre", { text: block.log })]),
};

// Charts are drawn once they are in the page and have a size.
const later = [];

// Buttons that show and hide: a case each, and the records of all.
function addLegend(legend, block, chart) {
  const hidden = new Set();
  let records = block.records;
  const refresh = () => {
    chart.data.datasets.forEach(({ line }, i) =>
      chart.setDatasetVisibility(i, !hidden.has(line.group) && (line.kind !== "record" || records)));
    chart.update();
  };
  const toggle = (children, pressed, act, className) => {
    const button = element("button", { type: "button", className, ariaPressed: String(pressed) }, children);
    button.addEventListener("click", () => {
      const now = button.ariaPressed !== "true";
      button.ariaPressed = String(now);
      act(now);
      refresh();
    });
    legend.append(button);
  };
  block.groups.forEach((group, g) => {
    const swatch = element("span", { className: "swatch", "aria-hidden": "true" });
    swatch.style.borderTopColor = "#" + group.colour;
    swatch.style.borderTopStyle = { solid: "solid", "(12,5)": "dashed" }[group.dash] ?? "dotted";
    toggle([swatch, group.label], true, (shown) => shown ? hidden.delete(g) : hidden.add(g), "case");
  });
  const has = (kind) => block.lines.some((line) => line.kind === kind);
  if (has("record") && has("mean")) toggle(["Every record"], records, (shown) => { records = shown; }, "toggle");
  refresh();
}

function drawPage(report) {
  const fill = (id, text) => { document.getElementById(id).textContent = text; };
  document.title = `${report.study}: Seapile report`;
  fill("study", report.study);
  fill("question", report.question);
  fill("made", report.made);
  document.getElementById("counts").append(
    ...report.counts.map(({ words, tone }) => element("li", { className: tone, text: words })));
  for (const section of report.sections) {
    document.getElementById("contents").append(
      element("li", {}, [element("a", { href: `#${section.id}`, text: section.title })]));
    document.getElementById("sections").append(element("section", { id: section.id }, [
      element("h2", { text: section.title }), ...section.blocks.map((block) => draw[block.type](block))]));
  }
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  for (const act of later) act();
}

drawPage(JSON.parse(document.getElementById("data").textContent));
