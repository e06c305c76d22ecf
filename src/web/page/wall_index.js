// SPDX-License-Identifier: MIT
const kExplained_m = 0.1;  // a return this near to a wall is that wall
const kCell_m = 0.5;

// Walls by cells of the plane, to find the wall near a point at once.
export class WallIndex {
  constructor(walls, thickness) {
    this.cells = new Map();
    for (const wall of walls) {
      const reach = (wall.thickness ?? thickness) / 2 + kExplained_m;
      const [ax, ay] = wall.from, [bx, by] = wall.to;
      const length = Math.hypot(bx - ax, by - ay);
      const steps = Math.max(1, Math.ceil(length / kCell_m));
      const entry = { ax, ay, dx: (bx - ax) / (length || 1), dy: (by - ay) / (length || 1), length, reach };
      for (let i = 0; i <= steps; ++i) {
        const x = ax + (bx - ax) * i / steps, y = ay + (by - ay) * i / steps;
        const spread = Math.ceil(reach / kCell_m);
        for (let u = -spread; u <= spread; ++u) {
          for (let v = -spread; v <= spread; ++v) {
            const key = this.key(x + u * kCell_m, y + v * kCell_m);
            if (!this.cells.has(key)) this.cells.set(key, new Set());
            this.cells.get(key).add(entry);
          }
        }
      }
    }
  }
  key(x, y) { return `${Math.floor(x / kCell_m)},${Math.floor(y / kCell_m)}`; }
  contains(x, y) {
    for (const w of this.cells.get(this.key(x, y)) ?? []) {
      const along = (x - w.ax) * w.dx + (y - w.ay) * w.dy;
      const across = Math.abs((y - w.ay) * w.dx - (x - w.ax) * w.dy);
      if (across < w.reach && along > -w.reach && along < w.length + w.reach) return true;
    }
    return false;
  }
}
