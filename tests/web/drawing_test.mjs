// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { join } from "node:path";
import { onScreen, sizes, tree, until, withBench } from "./bench.mjs";

// Where the emulated robot is: a room that nobody has drawn yet.
const room = { format: "cornerd-map", version: 1, name: "truth", thickness: 0.1, walls: [
  { from: [0, 0], to: [3.6, 0] }, { from: [3.6, 0], to: [3.6, 2.4] }, { from: [3.6, 2.4], to: [2.5, 2.4] },
  { from: [1.6, 2.4], to: [0, 2.4] }, { from: [0, 2.4], to: [0, 0] }] };
const robot = { x: 1.3, y: 1.0, theta: 0.3 };
// The draft is in the frame of the robot.
const seen = ([x, y]) => {
  const [dx, dy, c, s] = [x - robot.x, y - robot.y, Math.cos(robot.theta), Math.sin(robot.theta)];
  return [c * dx + s * dy, c * dy - s * dx];
};

async function drag(page, from, to) {
  const [a, b] = [await onScreen(page, from), await onScreen(page, to)];
  await page.mouse.move(a.x, a.y);
  await page.mouse.down();
  await page.mouse.move((a.x + b.x) / 2, (a.y + b.y) / 2, { steps: 3 });
  await page.mouse.move(b.x, b.y, { steps: 3 });
  await page.mouse.up();
}
const tap = async (page, p) => {
  const at = await onScreen(page, p);
  await page.mouse.click(at.x, at.y);
};
async function checked(page, words) {
  let said;
  await until(`checked: ${words}`, async () => (said = await page.textContent("#checked")).includes(words), 10000)
    .catch((error) => { throw new Error(`${error.message}; said is: ${said}`); });
}

for (const [name, size] of Object.entries(sizes)) {
  test(`a drawn room with a door is a map in which the robot localizes: ${name}`, withBench(async (bench) => {
    await bench.start(bench.write("other.json", readFileSync(join(tree, "config/maps/krpai-2019-b.json"), "utf8")),
      { map: bench.write("truth.json", room), args: ["--pose", `${robot.x},${robot.y},${robot.theta}`] });
    const page = await bench.browse(size);
    await bench.state(page, "lost", "ambiguous");
    await until("a scan", async () => { await page.click("#edit"); await page.click("#new-map"); return page.$eval("#map", (canvas) => canvas.dataset.scale > 20); });
    await checked(page, "/walls");  // an empty map is none, in the reader's words

    // By hand: some centimetres off.
    const off = 0.04;
    const corners = [[0 + off, 0], [3.6, off], [3.6 - off, 2.4], [0, 2.4 - off]].map(seen);
    for (let i = 0; i < 4; ++i) await drag(page, corners[i], corners[(i + 1) % 4]);
    if (process.env.SCREENSHOTS) await page.screenshot({ path: join(process.env.SCREENSHOTS, `walls-${name}.png`) });
    await checked(page, "4 walls, ");
    await page.click("[data-tool=door]");
    await drag(page, seen([2.45, 2.4]), seen([1.65, 2.4]));
    await checked(page, "5 walls");
    await page.click("[data-tool=room]");
    await drag(page, corners[0], corners[2]);
    await page.fill("#room-name", "workshop");
    await page.fill("#map-name", "drawn");
    if (process.env.SCREENSHOTS) await page.screenshot({ path: join(process.env.SCREENSHOTS, `draft-${name}.png`) });
    await page.click("#save-map");
    await bench.state(page, "fix", "tracking");
    // The frame of the drawing is that of the robot when it began.
    for (const id of ["x", "y"]) {
      const value = Number(await page.textContent(`#${id}`));
      assert.ok(Math.abs(value) < 0.05, `${id} = ${value}`);
    }
    const theta = Number(await page.textContent("#theta"));
    assert.ok(Math.abs(theta) < 0.02, `theta = ${theta}`);
    assert.equal(await page.textContent("#place"), "workshop");

    const check = await bench.call("cornerctl", ["map", "check", bench.path("drawn.json")]);
    assert.equal(check.code, 0, check.errors);
    assert.match(check.output, /walls +5/);
    const drawn = JSON.parse(readFileSync(bench.path("drawn.json"), "utf8"));
    const walls = drawn.walls.map(({ from, to }) => Math.hypot(to[0] - from[0], to[1] - from[1])).sort((a, b) => b - a);
    console.log(`walls of ${walls.map((n) => n.toFixed(3)).join(", ")} m`);
    for (const [i, n] of [3.6, 2.4, 2.4].entries()) assert.ok(Math.abs(walls[i] - n) < 0.03, `${walls[i]} for ${n} m`);

    // The name is taken now: nothing is replaced.
    await page.click("#edit");
    await page.fill("#map-name", "drawn");
    await page.click("#save-map");
    await until("the refusal", async () => (await page.textContent("#told")).includes("exists"));
    assert.deepEqual(page.problems, []);
  }));
}

test("tools of the editor: split, move, delete, undo", withBench(async (bench) => {
  await bench.start(bench.write("room.json", room), { args: ["--pose", `${robot.x},${robot.y},${robot.theta}`] });
  const page = await bench.browse(sizes.desk);
  await bench.state(page, "fix", "tracking");
  await page.click("#edit");
  await checked(page, "5 walls");
  await page.click("[data-tool=split]");
  await tap(page, [1.8, 0]);
  await checked(page, "6 walls");
  await page.click("[data-tool=move]");
  await drag(page, [1.8, 0], [1.8, -0.5]);
  await checked(page, "x 3.01 m");
  await page.click("[data-tool=delete]");
  await tap(page, [0, 1.2]);
  await checked(page, "5 walls");
  await page.keyboard.press("Control+z");
  await checked(page, "6 walls");
  await page.click("#undo");
  await page.click("#undo");
  await checked(page, " 3.70 x 2.50 m");
  await page.click("#close-draft");
  assert.ok(!(await page.isVisible("#draft")));
  assert.deepEqual(page.problems, []);
}));
