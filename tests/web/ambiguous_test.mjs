// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { test } from "node:test";
import { onScreen, sizes, symmetricRoom, until, withBench } from "./bench.mjs";

const truth = { x: 1.1, y: 0.8, theta: 0.4 };

test("a tap on the right ghost ends an ambiguous", withBench(async (bench) => {
  await bench.start(bench.write("room.json", symmetricRoom), { args: ["--pose", `${truth.x},${truth.y},${truth.theta}`] });
  const page = await bench.browse(sizes.phone);
  await bench.state(page, "ambiguous");
  assert.equal(await page.textContent("#x"), "–");
  const at = await onScreen(page, [truth.x, truth.y]);
  await page.touchscreen.tap(at.x, at.y);
  await bench.state(page, "fix", "tracking");
  assert.ok(Math.abs(Number(await page.textContent("#x")) - truth.x) < 0.05);
  assert.ok(Math.abs(Number(await page.textContent("#theta")) - truth.theta) < 0.05);
  await page.click("#relocalize");
  await bench.state(page, "ambiguous");

  // "You are here": press, drag to where it looks.
  await page.click("#here");
  const from = await onScreen(page, [truth.x, truth.y]);
  const to = await onScreen(page, [truth.x + Math.cos(truth.theta), truth.y + Math.sin(truth.theta)]);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 4 });
  await page.mouse.up();
  await bench.state(page, "fix", "tracking");
  await until("the right one", async () => Math.abs(Number(await page.textContent("#y")) - truth.y) < 0.05);
  assert.deepEqual(page.problems, []);
}));
