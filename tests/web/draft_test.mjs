// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { test } from "node:test";
import { Draft } from "./page/draft.js";

const kReach = 0.1;
const near = (a, b, tolerance = 1e-6) => a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) < tolerance, `${a} for ${b}`));
const draft = (...walls) => new Draft({ thickness: 0.1, walls: walls.map(([from, to]) => ({ from, to })) });

test("a wall snaps to right angles of the walls, not to others", () => {
  const one = draft([[0, 0], [3, 0]]);
  near(one.addWall([3.02, 0.03], [3.1, 2], kReach).to, [3, 2], 0.01);
  const slanted = one.addWall([0, 1], [1, 2], kReach);
  near(slanted.to, [1, 2]);
});

test("a wall that ends at another meets it, and at an end both do", () => {
  const one = draft([[0, 0], [3, 0]], [[3, 0], [3, 2]]);
  near(one.addWall([1, 0.05], [1.02, 1.5], kReach).from, [1, 0], 0.03);
  near(one.addWall([2.95, 2.05], [0, 2], kReach).from, one.walls[1].to);
});

test("a wall that is let go at an end has its end there, whatever right angles and the scan say", () => {
  const one = draft([[0, 0], [3, 0]], [[3, 0], [3, 1.9]], [[0, 0], [0, 2.5]]);
  const wall = one.addWall([3, 1.9], [0.05, 2.45], kReach);  // 11 degrees off
  near(wall.to, [0, 2.5]);
  near(one.walls[2].to, wall.to);
  near(one.walls[1].to, wall.from);
  const line = draft([[0, 0], [1, 0]]);
  line.scan = Array.from({ length: 100 }, (_, i) => [1 + i * 0.02, 0.12]);
  line.lidar = [1, 1];
  const more = line.addWall([3, 0.05], [1.05, 0.05], kReach);
  near(more.to, [1, 0]);
  near(line.walls[0].to, more.to);
});

test("the face of a wall lies on the scan, also at an angle of its own", () => {
  for (const angle of [0, 0.4]) {
    const one = draft();
    const direction = [Math.cos(angle), Math.sin(angle)], normal = [-direction[1], direction[0]];
    const point = (along, across) => [0, 1].map((i) => along * direction[i] + across * normal[i]);
    one.scan = Array.from({ length: 100 }, (_, i) => point(i * 0.02, 1 + 0.003 * Math.sin(7 * i)));
    const wall = one.addWall(point(0.1, 1.05), point(1.9, 0.95), kReach);
    near(wall.from, point(0.1, 1.05), 0.02);  // half a thickness behind the face
    near(wall.to, point(1.9, 1.05), 0.02);
  }
});

test("a door is a gap of the width that was drawn, or a door's", () => {
  const one = draft([[0, 0], [3, 0]]);
  assert.ok(one.door([1, 0], [1.7, 0], kReach));
  near([one.walls[0].to[0], one.walls[1].from[0]], [0.95, 1.75]);
  assert.ok(one.undo());
  assert.ok(one.door([1.5, 0], [1.5, 0], kReach));
  near([one.walls[0].to[0], one.walls[1].from[0]], [1.05, 1.95]);
  assert.ok(!one.door([1.5, 2], [1.7, 2], kReach));
});

test("walls keep what the page knows nothing of; undo takes back every step", () => {
  const one = new Draft({ thickness: 0.1, sigma: 0.03, walls: [{ from: [0, 0], to: [3, 0], sigma: 0.02, thickness: 0.2 }] });
  assert.ok(one.split([1, 0], kReach));
  assert.equal(one.toMap("a").walls[1].sigma, 0.02);
  assert.equal(one.toMap("a").sigma, 0.03);
  const grip = one.grab([1, 0], kReach);
  grip.drag(grip, [1, 1]);
  near(one.walls[0].to, one.walls[1].from);
  assert.ok(one.remove([2, 0.5], kReach));
  for (let i = 0; i < 3; ++i) assert.ok(one.undo());
  assert.ok(!one.undo());
  near(one.walls[0].to, [3, 0]);
});

test("a wall that is dragged near the scan lies on it, with the walls that meet it", () => {
  const one = draft([[0, 0], [3, 0]], [[3, 0], [3, 2]]);
  one.scan = Array.from({ length: 100 }, (_, i) => [2.5, 0.05 + i * 0.02]);
  one.lidar = [1, 1];
  const grip = one.grab([3, 1], kReach);
  grip.drag(grip, [2.6, 1]);
  grip.release();
  near(one.walls[1].from, [2.55, 0]);
  near(one.walls[0].to, [2.55, 0]);
});
