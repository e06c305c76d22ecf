// SPDX-License-Identifier: MIT
// The picture: map, robot, scan. Coordinates are metres in the map; y is up.

const kTrailPoses = 2000;
const kExplained_m = 0.1;  // a return this near to a wall is that wall
const kCell_m = 0.5;

const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

// Walls by cells of the plane, to find the wall near a point at once.
class WallIndex {
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
  explains(x, y) {
    for (const w of this.cells.get(this.key(x, y)) ?? []) {
      const along = (x - w.ax) * w.dx + (y - w.ay) * w.dy;
      const across = Math.abs((y - w.ay) * w.dx - (x - w.ax) * w.dy);
      if (across < w.reach && along > -w.reach && along < w.length + w.reach) return true;
    }
    return false;
  }
}

export class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.center = { x: 0, y: 0 };
    this.scale = 60;  // CSS pixels a metre
    this.following = true;
    this.trail = [];
    this.ghosts = [];
    this.points = [];
    this.corners = [];
    new ResizeObserver(() => this.resize()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    this.resize();
  }

  resize() {
    this.ratio = window.devicePixelRatio || 1;
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    this.canvas.width = Math.round(this.width * this.ratio);
    this.canvas.height = Math.round(this.height * this.ratio);
    this.draw();
  }

  toScreen({ x, y }) {
    return { x: this.width / 2 + (x - this.center.x) * this.scale, y: this.height / 2 - (y - this.center.y) * this.scale };
  }
  toMap({ x, y }) {
    return { x: this.center.x + (x - this.width / 2) / this.scale, y: this.center.y - (y - this.height / 2) / this.scale };
  }

  setMap(map) {
    this.map = map;
    this.index = new WallIndex(map.walls, map.thickness ?? 0);
    this.trail = [];
    this.showWhole();
  }

  showWhole() {
    if (!this.map) return;
    const xs = this.map.walls.flatMap((wall) => [wall.from[0], wall.to[0]]);
    const ys = this.map.walls.flatMap((wall) => [wall.from[1], wall.to[1]]);
    const low = { x: xs.reduce((a, b) => Math.min(a, b)), y: ys.reduce((a, b) => Math.min(a, b)) };
    const high = { x: xs.reduce((a, b) => Math.max(a, b)), y: ys.reduce((a, b) => Math.max(a, b)) };
    this.center = { x: (low.x + high.x) / 2, y: (low.y + high.y) / 2 };
    const beside = this.width > 900 ? 640 : 0;  // the panel, on both sides
    this.scale = 0.95 * Math.min((this.width - beside) / (high.x - low.x + 0.2), (this.height - 150) / (high.y - low.y + 0.2));
    this.draw();
  }

  setPose(pose) {
    this.pose = pose.x === undefined ? null : pose;
    this.ghosts = pose.alternatives ?? [];
    if (this.pose) {
      this.trail.push({ x: pose.x, y: pose.y });
      if (this.trail.length > kTrailPoses) this.trail.shift();
      if (this.following) this.center = { x: pose.x, y: pose.y };
    }
    this.draw();
  }

  // Points of the lidar in the map, for the pose that holds at the middle of the scan.
  setScan(points) {
    this.points = points.map((p) => ({ ...p, known: !this.index || this.index.explains(p.x, p.y) }));
    this.draw();
  }
  setCorners(corners) { this.corners = corners; }

  zoom(factor, at) {
    const fixed = this.toMap(at);
    this.scale = Math.min(2000, Math.max(0.5, this.scale * factor));
    const now = this.toMap(at);
    if (!this.following) this.center = { x: this.center.x + fixed.x - now.x, y: this.center.y + fixed.y - now.y };
    this.draw();
  }
  pan(dx, dy) {
    this.center = { x: this.center.x - dx / this.scale, y: this.center.y + dy / this.scale };
    this.draw();
  }

  ghostAt(screen) {
    return this.ghosts.find((ghost) => {
      const at = this.toScreen(ghost);
      return Math.hypot(at.x - screen.x, at.y - screen.y) < 24;
    });
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.paint();
    });
  }

  paint() {
    const c = this.context;
    c.textBaseline = "alphabetic";
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    this.paintMap(c);
    this.paintTrail(c);
    this.paintScan(c);
    this.ghosts.forEach((ghost, i) => this.paintGhost(c, ghost, i + 1));
    if (this.pose) this.paintRobot(c, this.pose);
    if (this.aim) this.paintArrow(c, this.aim);
    this.paintScaleBar(c);
  }

  polygon(c, points) {
    c.beginPath();
    points.forEach((point, i) => {
      const { x, y } = this.toScreen(point);
      i ? c.lineTo(x, y) : c.moveTo(x, y);
    });
    c.closePath();
  }

  paintMap(c) {
    if (!this.map) return;
    c.font = "13px system-ui, sans-serif";
    c.textAlign = "center";
    for (const room of this.map.rooms ?? []) {
      const points = room.polygon.map(([x, y]) => ({ x, y }));
      this.polygon(c, points);
      c.fillStyle = color("room");
      c.fill();
      const middle = points.reduce((sum, p) => ({ x: sum.x + p.x / points.length, y: sum.y + p.y / points.length }), { x: 0, y: 0 });
      const at = this.toScreen(middle);
      c.fillStyle = color("soft");
      c.fillText(room.name, at.x, at.y);
    }
    c.fillStyle = c.strokeStyle = color("wall");
    c.lineWidth = 1;
    for (const wall of this.map.walls) {
      const half = (wall.thickness ?? this.map.thickness ?? 0) / 2;
      const [ax, ay] = wall.from, [bx, by] = wall.to;
      const length = Math.hypot(bx - ax, by - ay) || 1;
      const u = { x: (bx - ax) / length * half, y: (by - ay) / length * half };
      this.polygon(c, [
        { x: ax - u.x - u.y, y: ay - u.y + u.x }, { x: bx + u.x - u.y, y: by + u.y + u.x },
        { x: bx + u.x + u.y, y: by + u.y - u.x }, { x: ax - u.x + u.y, y: ay - u.y - u.x }]);
      c.fill();
      c.stroke();  // a line wall is seen too
    }
  }

  paintTrail(c) {
    c.strokeStyle = color("trail");
    c.lineWidth = 2;
    c.beginPath();
    let before = null;
    for (const point of this.trail) {
      const at = this.toScreen(point);
      // A robot that was carried leaves no line.
      const jumped = before && Math.hypot(point.x - before.x, point.y - before.y) > 0.5;
      before && !jumped ? c.lineTo(at.x, at.y) : c.moveTo(at.x, at.y);
      before = point;
    }
    c.stroke();
  }

  paintScan(c) {
    const known = color("scan"), unknown = color("unexplained");
    for (const point of this.points) {
      const { x, y } = this.toScreen(point);
      c.fillStyle = point.known ? known : unknown;
      c.fillRect(x - 1.25, y - 1.25, 2.5, 2.5);
    }
    c.strokeStyle = color("corner");
    c.lineWidth = 1.5;
    for (const corner of this.corners) {
      const { x, y } = this.toScreen(corner);
      c.beginPath();
      corner.kind === "corner" ? c.rect(x - 4, y - 4, 8, 8) : c.arc(x, y, 4, 0, 7);
      c.stroke();
    }
  }

  paintRobot(c, { x, y, theta, cov }) {
    const at = this.toScreen({ x, y });
    c.save();
    c.translate(at.x, at.y);
    if (cov) {
      // 95 % of a normal distribution in the plane: 2.45 sigma.
      const mean = (cov.xx + cov.yy) / 2;
      const spread = Math.hypot((cov.xx - cov.yy) / 2, cov.xy);
      c.save();
      c.rotate(-Math.atan2(2 * cov.xy, cov.xx - cov.yy) / 2);
      c.beginPath();
      const radius = (variance) => Math.max(1, 2.45 * Math.sqrt(Math.max(0, variance)) * this.scale);
      c.ellipse(0, 0, radius(mean + spread), radius(mean - spread), 0, 0, 7);
      c.fillStyle = color("sigma");
      c.fill();
      c.restore();
    }
    c.rotate(-theta);
    c.fillStyle = color("robot");
    c.beginPath();
    c.moveTo(20, 0);
    c.lineTo(6, -8);
    c.lineTo(6, 8);
    c.fill();
    c.beginPath();
    c.arc(0, 0, 9, 0, 7);
    c.fill();
    c.restore();
  }

  paintGhost(c, ghost, number) {
    const at = this.toScreen(ghost);
    c.save();
    c.translate(at.x, at.y);
    c.strokeStyle = c.fillStyle = color("ghost");
    c.lineWidth = 2;
    c.beginPath();
    c.arc(0, 0, 14, 0, 7);
    c.moveTo(14 * Math.cos(ghost.theta), -14 * Math.sin(ghost.theta));
    c.lineTo(26 * Math.cos(ghost.theta), -26 * Math.sin(ghost.theta));
    c.stroke();
    c.font = "600 14px system-ui, sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.fillText(String(number), 0, 0);
    c.restore();
  }

  paintArrow(c, { x, y, theta }) {
    this.paintRobot(c, { x, y, theta });
    const from = this.toScreen({ x, y });
    c.strokeStyle = color("robot");
    c.lineWidth = 3;
    c.beginPath();
    c.moveTo(from.x, from.y);
    c.lineTo(from.x + 60 * Math.cos(theta), from.y - 60 * Math.sin(theta));
    c.stroke();
  }

  paintScaleBar(c) {
    const rough = 120 / this.scale;
    const power = 10 ** Math.floor(Math.log10(rough));
    const length = [5, 2, 1].map((n) => n * power).find((n) => n <= rough);
    const x = this.width - 20, y = this.height - 80;
    c.strokeStyle = c.fillStyle = color("soft");
    c.lineWidth = 2;
    c.strokeRect(x - length * this.scale, y - 1, length * this.scale, 1);
    c.font = "12px system-ui, sans-serif";
    c.textAlign = "right";
    c.fillText(length >= 1 ? `${length} m` : `${Math.round(length * 100)} cm`, x, y - 8);
  }
}
