// SPDX-License-Identifier: MIT
// A map that is being drawn: walls, rooms, snapping, undo. Pure; points are [x, y] in metres.

export const kDoor_m = 0.8;
const kRightAngle_rad = 12 * Math.PI / 180;  // nearer than this to a right angle is one
const kMinWall_m = 0.05;
const kJoin_m = 0.5;  // at most, from where an end was drawn to where its walls meet
const kMinScanPoints = 8;
const kHalfChord = 4;       // samples; a piece of the scan of twice as many shows a direction
const kStraight_m = 0.015;  // where its middle is no farther off
const kDrawnSigma_m = 0.02;

const sub = (a, b) => [a[0] - b[0], a[1] - b[1]];
const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1];
const cross = (a, b) => a[0] * b[1] - a[1] * b[0];
const length = (a) => Math.hypot(a[0], a[1]);
export const distance = (a, b) => length(sub(a, b));
const unit = (a) => { const n = length(a) || 1; return [a[0] / n, a[1] / n]; };
const round = (p) => p.map((v) => Math.round(v * 1e4) / 1e4);
const same = (a, b) => distance(a, b) < 1e-3;

// The point of a wall that is nearest to p.
export function nearestOn(wall, p) {
  const d = sub(wall.to, wall.from);
  const share = Math.max(0, Math.min(1, dot(sub(p, wall.from), d) / (dot(d, d) || 1)));
  return add(wall.from, d, share);
}

// Where two lines meet, each through a point along a direction; null if they are nearly parallel.
function meet(p, d, q, e) {
  const sine = cross(d, e);
  if (Math.abs(sine) < 0.3 * length(d) * length(e)) return null;
  return add(p, d, cross(sub(q, p), e) / sine);
}

// The angle of most of these segments, from 0 to a right angle; null where there is none.
function mainDirection(segments) {
  let x = 0, y = 0;
  for (const [a, b] of segments) {
    const d = sub(b, a), n = length(d), angle = 4 * Math.atan2(d[1], d[0]);
    x += n * Math.cos(angle);
    y += n * Math.sin(angle);
  }
  return x || y ? Math.atan2(y, x) / 4 : null;
}

export class Draft {
  // `map`: a MAP message, or null for an empty one.
  constructor(map, thickness = 0.1) {
    this.thickness = map?.thickness ?? thickness;
    this.sigma = map ? map.sigma : kDrawnSigma_m;
    this.walls = structuredClone(map?.walls ?? []);
    this.rooms = structuredClone(map?.rooms ?? []);
    this.scan = [];        // points of the lidar in the map
    this.lidar = [0, 0];   // where they were seen from
    this.done = [];
  }

  toMap(name) {
    const map = { format: "cornerd-map", version: 1, name, thickness: this.thickness };
    if (this.sigma !== undefined) map.sigma = this.sigma;
    map.walls = this.walls.map((wall) => ({ ...wall, from: round(wall.from), to: round(wall.to) }));
    map.rooms = this.rooms.map((room) => ({ ...room, polygon: room.polygon.map(round) }));
    return map;
  }

  remember() {
    this.done.push(structuredClone({ walls: this.walls, rooms: this.rooms, thickness: this.thickness }));
    if (this.done.length > 200) this.done.shift();
  }
  undo() {
    const before = this.done.pop();
    if (before) Object.assign(this, before);
    return before !== undefined;
  }

  // Right angles are those of the walls, or of the scan where there is no wall yet.
  axis() {
    if (this.walls.length) return mainDirection(this.walls.map((wall) => [wall.from, wall.to]));
    const chords = this.scan.slice(2 * kHalfChord).map((p, i) => [this.scan[i], p, this.scan[i + kHalfChord]]);
    return mainDirection(chords.filter(([a, b, middle]) => {
      const n = distance(a, b);
      return n > 0.05 && n < 1 && Math.abs(cross(sub(middle, a), sub(b, a))) / n < kStraight_m;
    }));
  }

  endNear(p, radius) {
    const ends = this.walls.flatMap((wall) => [wall.from, wall.to]);
    const nearest = ends.reduce((best, end) => distance(end, p) < distance(best ?? [Infinity, 0], p) ? end : best, null);
    return nearest && distance(nearest, p) <= radius ? nearest : null;
  }
  wallNear(p, radius) {
    let best = null, least = Infinity;
    for (const wall of this.walls) {
      const off = Math.max(0, distance(nearestOn(wall, p), p) - (wall.thickness ?? this.thickness) / 2);
      if (off <= radius && off < least) [best, least] = [wall, off];
    }
    return best;
  }
  snapPoint(p, radius) {
    const end = this.endNear(p, radius);
    if (end) return end;
    const wall = this.wallNear(p, radius);
    return wall ? nearestOn(wall, p) : p;
  }
  // p turned about `from` to a right angle, where it nearly is at one.
  snapAngle(from, p) {
    const axis = this.axis();
    if (axis === null) return p;
    const d = sub(p, from), off = Math.atan2(d[1], d[0]) - axis;
    const turned = off - Math.round(off / (Math.PI / 2)) * Math.PI / 2;
    if (Math.abs(turned) > kRightAngle_rad) return p;
    const along = axis + off - turned;
    const direction = [Math.cos(along), Math.sin(along)];
    return add(from, direction, dot(d, direction));
  }

  // The wall that a stroke from a to b means. Its face lies on the scan under it, its ends where it
  // meets the walls that they were drawn to. null: too short.
  wallFrom(a, b, radius) {
    const starts = this.wallsAt(a, radius), ends = this.wallsAt(b, radius);
    let from = this.snapPoint(a, radius), to = this.snapAngle(from, b);
    if (ends.length) to = this.snapAngle(from, this.snapPoint(b, radius));
    if (distance(from, to) < kMinWall_m) return null;
    [from, to] = this.fitToScan(from, to, Math.max(radius, 0.15));
    const d = sub(to, from);
    // An end that was drawn to another one is there in any case.
    [from, to] = [[from, starts, a], [to, ends, b]].map(([end, walls, drawn]) => {
      const old = this.endNear(drawn, radius);
      return walls.map((wall) => meet(from, d, wall.from, sub(wall.to, wall.from)))
        .find((at) => at && distance(at, old ?? end) <= kJoin_m) ?? old ?? end;
    });
    return { from: [...from], to: [...to] };
  }
  wallsAt(p, radius) {
    const end = this.endNear(p, radius);
    if (end) return this.walls.filter((wall) => same(wall.from, end) || same(wall.to, end));
    const wall = this.wallNear(p, radius);
    return wall ? [wall] : [];
  }

  // The wall moved so that its face is where the scan is; turned too, unless it is at a right angle.
  fitToScan(from, to, band) {
    const u = unit(sub(to, from)), normal = [-u[1], u[0]], n = distance(from, to);
    const near = [];
    for (const p of this.scan) {
      const d = sub(p, from), along = dot(d, u), across = dot(d, normal);
      if (along > 0.05 && along < n - 0.05 && Math.abs(across) < band + this.thickness / 2) near.push([along, across]);
    }
    if (near.length < kMinScanPoints) return [from, to];
    const off = (slope) => near.map(([along, across]) => across - slope * along).sort((x, y) => x - y)[near.length >> 1];
    const axis = this.axis();
    const isRight = axis !== null && Math.abs(Math.sin(2 * (Math.atan2(u[1], u[0]) - axis))) < 1e-3;
    let slope = 0;
    if (!isRight) {
      const mean = near.reduce((m, p) => add(m, p, 1 / near.length), [0, 0]);
      let xx = 0, xy = 0;
      for (const [x, y] of near) [xx, xy] = [xx + (x - mean[0]) ** 2, xy + (x - mean[0]) * (y - mean[1])];
      slope = xx > 0 ? xy / xx : 0;
    }
    // The solid is on the side away from the lidar.
    const away = dot(sub(from, this.lidar), normal) > 0 ? 1 : -1;
    const first = off(slope) + away * this.thickness / 2;
    return [add(from, normal, first), add(to, normal, first + slope * n)];
  }

  addWall(a, b, radius) {
    const wall = this.wallFrom(a, b, radius);
    if (!wall) return null;
    const met = [[wall.from, a], [wall.to, b]].map(([end, drawn]) => [end, this.endNear(drawn, radius)]);
    this.remember();
    // The walls that it was drawn to end where it does.
    for (const [end, old] of met) if (old) this.moveEnds(old, end);
    this.walls.push(wall);
    return wall;
  }
  moveEnds(from, to) {
    const old = [...from];
    for (const wall of this.walls) {
      for (const name of ["from", "to"]) if (same(wall[name], old)) wall[name] = [...to];
    }
  }

  // What a finger drags: all ends at one point, or a wall with the ends that meet it. A wall that is let
  // go near the scan lies on it.
  grab(p, radius) {
    const end = this.endNear(p, radius);
    if (end) {
      this.remember();
      return { at: [...end], drag: (grip, to) => {
        const free = this.walls.filter((wall) => same(wall.from, grip.at) || same(wall.to, grip.at));
        const fixed = free.length === 1 && (same(free[0].from, grip.at) ? free[0].to : free[0].from);
        const others = this.walls.filter((wall) => !free.includes(wall));
        const target = others.flatMap((wall) => [wall.from, wall.to]).find((one) => distance(one, to) < radius);
        const at = target ?? (fixed ? this.snapAngle(fixed, to) : to);
        this.moveEnds(grip.at, at);
        grip.at = [...at];
      } };
    }
    const wall = this.wallNear(p, radius);
    if (!wall) return null;
    this.remember();
    return { at: p, drag: (grip, to) => {
      const u = unit(sub(wall.to, wall.from)), normal = [-u[1], u[0]];
      const shift = add([0, 0], normal, dot(sub(to, grip.at), normal));
      const [from, end] = [[...wall.from], [...wall.to]];
      this.moveEnds(from, add(from, shift));
      this.moveEnds(end, add(end, shift));
      grip.at = to;
    }, release: () => {
      const [from, end] = [[...wall.from], [...wall.to]];
      const [onFrom, onEnd] = this.fitToScan(from, end, radius);
      this.moveEnds(from, onFrom);
      this.moveEnds(end, onEnd);
    } };
  }
  split(p, radius) {
    const wall = this.wallNear(p, radius);
    if (!wall) return false;
    const at = nearestOn(wall, p);
    if (distance(at, wall.from) < kMinWall_m || distance(at, wall.to) < kMinWall_m) return false;
    this.remember();
    this.walls.push({ ...structuredClone(wall), from: at });
    wall.to = [...at];
    delete wall.open;
    return true;
  }
  // A gap from a to b in the wall at a; of a door's width about a where both are one.
  door(a, b, radius) {
    const wall = this.wallNear(a, radius);
    if (!wall) return false;
    const u = unit(sub(wall.to, wall.from)), n = distance(wall.from, wall.to);
    let [first, last] = [a, b].map((p) => dot(sub(p, wall.from), u)).sort((x, y) => x - y);
    if (last - first < kMinWall_m) [first, last] = [first - kDoor_m / 2, last + kDoor_m / 2];
    // The wall's ends reach half a thickness into the gap.
    const half = (wall.thickness ?? this.thickness) / 2;
    first -= half;
    last += half;
    if (first <= 0 && last >= n) return false;
    this.remember();
    const pieces = [];
    if (first > kMinWall_m) pieces.push({ ...structuredClone(wall), to: add(wall.from, u, first) });
    if (last < n - kMinWall_m) pieces.push({ ...structuredClone(wall), from: add(wall.from, u, last) });
    for (const piece of pieces) delete piece.open;
    this.walls.splice(this.walls.indexOf(wall), 1, ...pieces);
    return true;
  }
  remove(p, radius) {
    const wall = this.wallNear(p, radius), room = wall ? null : this.roomAt(p);
    if (!wall && !room) return false;
    this.remember();
    if (wall) this.walls.splice(this.walls.indexOf(wall), 1);
    else this.rooms.splice(this.rooms.indexOf(room), 1);
    return true;
  }

  roomAt([x, y]) {
    return this.rooms.find(({ polygon }) => polygon.reduce((inside, [ax, ay], i) => {
      const [bx, by] = polygon[(i + 1) % polygon.length];
      return (ay > y) !== (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) ? !inside : inside;
    }, false)) ?? null;
  }
  addRoom(polygon) {
    this.remember();
    const taken = new Set(this.rooms.map((room) => room.name));
    let number = 1;
    while (taken.has(`room-${number}`)) ++number;
    const room = { name: `room-${number}`, polygon };
    this.rooms.push(room);
    return room;
  }
  // From corner to corner, along the right angles of the map.
  rectangle(a, b) {
    const axis = this.axis() ?? 0, u = [Math.cos(axis), Math.sin(axis)];
    const along = add([0, 0], u, dot(sub(b, a), u));
    return [a, add(a, along), b, sub(b, along)];
  }
}
