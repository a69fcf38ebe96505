"use strict";
// Labels of the main plot where there is room: not over symbols, other labels, intervals or the front. The last two are
// thin: the line between a symbol and its label may cross them.
const boxAround = (x, y, w, h) => ({ left: x - w, right: x + w, top: y - h, bottom: y + h });
const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

function drawLabels(svg, x, y, points, taken) {
  const { width, height, left, right, top, bottom } = plotBox;
  for (const p of points) {
    p.at = [x(p.x.value), y(p.y.value)];
    taken.push(boxAround(...p.at, 8, 8));
    taken.push({ left: x(p.x.low), right: x(p.x.high), top: p.at[1] - 1, bottom: p.at[1] + 1, thin: true });
    taken.push({ left: p.at[0] - 1, right: p.at[0] + 1, top: y(p.y.high), bottom: y(Math.max(p.y.low, y.domain()[0])), thin: true });
  }
  const rank = p => p.c.base ? 0 : p.c.front ? 1 : p.kind === "biased" ? 2 : p.kind === "undecided" ? 3 : 4;
  const group = svg.append("g");
  for (const p of [...points].sort((a, b) => rank(a) - rank(b))) {
    const text = group.append("text").attr("class", "label").text(p.c.name).datum(p);
    const w = text.node().getComputedTextLength(), h = 15, [px, py] = p.at;
    const place = labelPlaces(w, h).map(([dx, dy]) => ({ left: px + dx, right: px + dx + w, top: py + dy - h / 2, bottom: py + dy + h / 2 }))
      .find(b => b.left > left + 4 && b.right < width - right && b.top > top && b.bottom < height - bottom - 2 &&
        !taken.some(t => overlap(b, t)) && !leaderBoxes(px, py, b).some(l => taken.some(t => !t.thin && overlap(l, t))));
    if (!place) { text.remove(); continue; } // it is shown when the symbol is picked
    text.attr("x", place.left).attr("y", place.top + 12);
    const far = nearestPoint(px, py, place), leader = leaderBoxes(px, py, place);
    taken.push(place, ...leader);
    if (leader.length) group.insert("line", ":first-child").attr("class", "leader").datum(p)
      .attr("x1", px + (far.x - px) * 0.25).attr("y1", py + (far.y - py) * 0.25).attr("x2", far.x).attr("y2", far.y);
  }
}

const nearestPoint = (x, y, box) => ({ x: Math.max(box.left, Math.min(x, box.right)), y: Math.max(box.top + 2, Math.min(y, box.bottom - 2)) });

/// Boxes along the line from a symbol to its label; none if they are near enough to do without.
function leaderBoxes(px, py, label) {
  const far = nearestPoint(px, py, label), length = Math.hypot(far.x - px, far.y - py), boxes = [];
  if (length <= 22) return boxes;
  for (let s = 13; s < length - 2; s += 5) boxes.push(boxAround(px + (far.x - px) * s / length, py + (far.y - py) * s / length, 1.5, 1.5));
  return boxes;
}

/// Places for a label of w by h beside a symbol, the best first: its left side and its middle from the symbol.
function labelPlaces(w, h) {
  const places = [[12, 0], [-12 - w, 0], [10, -13], [10, 13], [-10 - w, -13], [-10 - w, 13], [-w / 2, -18], [-w / 2, 18]];
  for (const r of [28, 40, 54, 70, 88, 108])
    for (const angle of [-0.5, 0.5, -2.6, 2.6, -1, 1, -2.1, 2.1, -1.4, 1.4, -1.75, 1.75])
      places.push([r * Math.cos(angle) - (Math.cos(angle) < 0 ? w : 0), r * Math.sin(angle)]);
  return places;
}
