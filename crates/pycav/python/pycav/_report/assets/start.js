// Puts everything into the page.

const run = JSON.parse(document.getElementById("run").textContent);
const viewer = new Viewer(run.viewer, document.getElementById("viewer"));
for (const clock of Object.values(run.clocks)) clock.values = decoded(clock.data);
const spans = {}, charts = run.charts.map((chart, k) => Object.assign(new Chart(chart, run.clocks, spans), {number: k}));
for (const chart of charts) {
  watch(chart, place => { if (chart.clock.symbol === "t") viewer.goTo(place); });
  document.getElementById("charts").append(chart.figure);
}
if (spans.t) {
  viewer.listeners.push(time => {
    spans.t.moment = time;
    for (const chart of spans.t.charts) chart.drawPointer();
  });
  viewer.go(viewer.step);
}
document.getElementById("downloads")?.append(downloads(run.name, run.clocks, charts));
