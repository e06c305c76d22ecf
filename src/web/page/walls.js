// SPDX-License-Identifier: MIT
// Walls as they are drawn: solids with square ends, and those of a draft with their ends.

export const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

// All walls as one path, in metres.
export function wallPaths(walls, thickness) {
  const path = new Path2D();
  for (const wall of walls) {
    const half = (wall.thickness ?? thickness) / 2;
    const [ax, ay] = wall.from, [bx, by] = wall.to;
    const length = Math.hypot(bx - ax, by - ay) || 1;
    const x = (bx - ax) / length * half, y = (by - ay) / length * half;
    path.moveTo(ax - x - y, ay - y + x);
    path.lineTo(bx + x - y, by + y + x);
    path.lineTo(bx + x + y, by + y - x);
    path.lineTo(ax - x + y, ay - y - x);
    path.closePath();
  }
  return path;
}

export function paintDraft(c, view) {
  const { draft, preview, outline } = view;
  view.paintRooms(c, draft.rooms);
  c.save();
  view.toMetres(c);
  c.lineWidth = 1 / view.scale;
  const fill = (walls, name) => {
    const paths = wallPaths(walls, draft.thickness);
    c.fillStyle = c.strokeStyle = color(name);
    c.fill(paths);
    c.stroke(paths);
  };
  fill(draft.walls, "wall");
  if (preview) fill([preview], "tracking");
  c.restore();
  c.fillStyle = color("tracking");
  const dot = ([px, py], radius) => {
    const { x, y } = view.toScreen({ x: px, y: py });
    c.beginPath();
    c.arc(x, y, radius, 0, 7);
    c.fill();
  };
  for (const wall of draft.walls) [wall.from, wall.to].forEach((end) => dot(end, 3.5));
  if (!outline?.length) return;
  view.polygon(c, outline.map(([x, y]) => ({ x, y })));
  c.strokeStyle = color("tracking");
  c.lineWidth = 2;
  c.stroke();
  outline.forEach((corner) => dot(corner, 4));
}
