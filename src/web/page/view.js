// SPDX-License-Identifier: MIT
// The picture: map, robot, scan. Coordinates are metres in the map; y is up.
import { paintArrow, paintGhost, paintRobot } from "./robots.js";
import { color, paintDraft, wallPaths } from "./walls.js";
import { WallIndex } from "./wall_index.js";

const kTrailPoses = 2000;
const kOutliers = 0.02;  // of a scan, at each end
const kFollow_m = 6;  // seen around the robot that is followed

export class View {
  // `free()`: the part of the canvas that nothing covers, in its pixels.
  constructor(canvas, free) {
    this.canvas = canvas;
    this.free = free;
    this.context = canvas.getContext("2d");
    this.center = { x: 0, y: 0 };
    this.scale = 60;  // CSS pixels a metre
    this.following = false;
    this.isFitted = true;
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
    this.isFitted ? this.showWhole() : this.draw();
  }

  toScreen({ x, y }) {
    return { x: this.width / 2 + (x - this.center.x) * this.scale, y: this.height / 2 - (y - this.center.y) * this.scale };
  }
  toMap({ x, y }) {
    return { x: this.center.x + (x - this.width / 2) / this.scale, y: this.center.y - (y - this.height / 2) / this.scale };
  }

  setMap(map) {
    this.map = map;
    if (!this.draft) this.setWalls(map.walls, map.thickness ?? 0);
    this.paths = wallPaths(map.walls, map.thickness ?? 0);
    this.trail = [];
    this.showWhole();
  }

  // The whole map in the part of the canvas that is free.
  showWhole() {
    this.isFitted = true;
    const points = (this.draft ?? this.map)?.walls.flatMap((wall) => [wall.from, wall.to]) ?? [];
    const scan = this.draft?.scan ?? [];
    if (!points.length && !scan.length) return;
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const i of [0, 1]) {
      // Without the outliers of the scan.
      const sorted = scan.map((p) => p[i]).sort((a, b) => a - b);
      const few = Math.floor(kOutliers * sorted.length);
      const all = [...points.map((p) => p[i]), ...sorted.slice(few, sorted.length - few)];
      for (const v of all) [low[i], high[i]] = [Math.min(low[i], v), Math.max(high[i], v)];
    }
    const free = this.free();
    const [width, height] = [free.right - free.left, free.bottom - free.top];
    this.scale = Math.min(2000, 0.95 * Math.min(width / (high[0] - low[0] + 0.2), height / (high[1] - low[1] + 0.2)));
    this.center = {
      x: (low[0] + high[0]) / 2 + (this.width / 2 - (free.left + free.right) / 2) / this.scale,
      y: (low[1] + high[1]) / 2 - (this.height / 2 - (free.top + free.bottom) / 2) / this.scale };
    this.draw();
  }

  follow(on) {
    this.following = on;
    this.isFitted = this.isFitted && !on;
    if (!on || !this.pose) return;
    this.scale = Math.max(this.scale, Math.min(this.width, this.height) / kFollow_m);
    this.center = { x: this.pose.x, y: this.pose.y };
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
    if (this.draft?.isHeld) return;
    this.points = points;
    this.compare();
  }
  // Which of them the walls do not have.
  compare() {
    for (const p of this.points) p.known = !this.index || this.index.contains(p.x, p.y);
    this.draw();
  }
  setWalls(walls, thickness) {
    this.index = new WallIndex(walls, thickness);
    this.compare();
  }
  setCorners(corners) { this.corners = corners; }

  zoom(factor, at) {
    this.isFitted = false;
    const fixed = this.toMap(at);
    this.scale = Math.min(2000, Math.max(0.5, this.scale * factor));
    const now = this.toMap(at);
    if (!this.following) this.center = { x: this.center.x + fixed.x - now.x, y: this.center.y + fixed.y - now.y };
    this.draw();
  }
  pan(dx, dy) {
    this.isFitted = false;
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
    if (this.draft) paintDraft(c, this);
    else this.paintMap(c);
    if (!this.draft) this.paintTrail(c);
    this.paintScan(c);
    this.ghosts.forEach((ghost, i) => paintGhost(c, this, ghost, i + 1));
    if (this.pose) paintRobot(c, this, this.pose);
    if (this.aim) paintArrow(c, this, this.aim);
    this.paintScaleBar(c);
    // For who looks at the pixels: of what pose, and where they are.
    Object.assign(this.canvas.dataset, { t: this.pose?.t ?? "", x: this.center.x, y: this.center.y, scale: this.scale });
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
    this.paintRooms(c, this.map.rooms ?? []);
    c.save();
    this.toMetres(c);
    c.fillStyle = c.strokeStyle = color("wall");
    c.lineWidth = 1 / this.scale;
    c.fill(this.paths);
    c.stroke(this.paths);  // a line wall is seen too
    c.restore();
  }
  // From here on the canvas takes metres of the map.
  toMetres(c) {
    const { x, y } = this.toScreen({ x: 0, y: 0 });
    c.transform(this.scale, 0, 0, -this.scale, x, y);
  }
  // All names above all rooms: one may lie within another.
  paintRooms(c, rooms) {
    const shapes = rooms.map((room) => room.polygon.map(([x, y]) => ({ x, y })));
    c.fillStyle = color("room");
    for (const points of shapes) {
      this.polygon(c, points);
      c.fill();
    }
    c.font = "13px system-ui, sans-serif";
    c.textAlign = "center";
    shapes.forEach((points, i) => {
      const middle = points.reduce((sum, p) => ({ x: sum.x + p.x / points.length, y: sum.y + p.y / points.length }), { x: 0, y: 0 });
      const at = this.toScreen(middle);
      c.fillStyle = color(rooms[i] === this.chosenRoom ? "tracking" : "soft");
      c.fillText(rooms[i].name, at.x, at.y);
    });
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

  paintScaleBar(c) {
    const rough = 120 / this.scale;
    const power = 10 ** Math.floor(Math.log10(rough));
    const length = [5, 2, 1].map((n) => n * power).find((n) => n <= rough);
    const x = this.width - 20, y = this.free().bottom + 24;
    c.strokeStyle = c.fillStyle = color("soft");
    c.lineWidth = 2;
    c.strokeRect(x - length * this.scale, y - 1, length * this.scale, 1);
    c.font = "12px system-ui, sans-serif";
    c.textAlign = "right";
    c.fillText(length >= 1 ? `${length} m` : `${Math.round(length * 100)} cm`, x, y - 8);
  }
}
