// Curves as text for other programs.

/** Columns over their clock, in SI units with all digits; what there is not is empty. */
function csv(clock, curves) {
  const head = [`${clock.symbol} / ${clock.unit}`, ...curves.map(curve => `${curve.name} / ${curve.chart.si}`)];
  const columns = [clock.values, ...curves.map(curve => curve.values)], rows = [head.join(",")];
  for (let row = 0; row < clock.values.length; row++) {
    rows.push(columns.map(column => Number.isNaN(column[row]) ? "" : String(column[row])).join(","));
  }
  return rows.join("\n") + "\n";
}

/** Hands a file to the reader. */
function save(name, text) {
  const address = URL.createObjectURL(new Blob([text], {type: "text/csv"}));
  const link = element("a", {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/** A row for each curve, and one for all that have the same clock. */
function downloads(name, clocks, charts) {
  const body = element("tbody");
  const row = (words, rows, file, clock, curves) => {
    const button = element("button", {type: "button", "aria-label": `${words} as CSV`, "data-file": file}, "CSV");
    button.addEventListener("click", () => save(`${name}-${file}.csv`, csv(clock, curves)));
    body.append(element("tr", {}, element("th", {scope: "row"}, words), element("td", {class: "n quiet"}, rows), element("td", {}, button)));
  };
  for (const [key, clock] of Object.entries(clocks)) {
    const curves = charts.flatMap(chart => chart.curves).filter(curve => curve.clock === clock);
    const kept = clock.values.length, count = kept === clock.rows ? `${kept.toLocaleString("en")} rows`
      : `extremes of ${clock.rows.toLocaleString("en")} rows: ${kept.toLocaleString("en")}; pycav report RUN --csv DIR writes all`;
    for (const curve of curves) row(`${curve.chart.title}, ${curve.label}`, count, curve.name.replaceAll("/", "-"), clock, [curve]);
    if (curves.length > 1) row(`all of the ${clock.label}`, count, key, clock, curves);
  }
  return element("table", {}, body);
}
