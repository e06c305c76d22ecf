// SPDX-License-Identifier: MIT
// What the page says of itself: old poses, a missing token, what is not permitted.
import assert from "node:assert/strict";
import { test } from "node:test";
import { join } from "node:path";
import { onScreen, sizes, symmetricRoom, tree, until, withBench } from "./bench.mjs";

const map = join(tree, "config/maps/krpai-2019-a.json");
const still = { args: ["--pose", "0.95,0.6,1.57"] };
const token = "0123456789abcdef0123";

test("a pose that nothing follows is said to be old, whoever stalls", withBench(async (bench) => {
  await bench.start(map, still);
  const page = await bench.browse(sizes.desk);
  for (const one of [bench.daemon, bench.web]) {
    await bench.state(page, "fix", "tracking");
    one.child.kill("SIGSTOP");
    await bench.state(page, "no pose");
    assert.match(await page.textContent("#meaning"), /^since \d+ s$/);
    assert.equal(await page.getAttribute("#state", "data-state"), "lost");
    one.child.kill("SIGCONT");
  }
  await bench.state(page, "fix", "tracking");
  assert.deepEqual(page.problems, []);
}));

test("a page without the token says so, or hides what it may not", withBench(async (bench) => {
  await bench.start(map, still);
  await bench.stop(bench.web);
  await bench.serve("--token-file", bench.write("token", `${token}\n`));
  const page = await bench.browse(sizes.desk);
  await bench.state(page, "fix", "tracking");
  for (const button of ["#here", "#relocalize", "#edit"]) assert.ok(await page.isHidden(button), button);
  assert.ok(await page.isVisible("#follow"));
  await page.goto(`${bench.url}/?token=${token}`);
  await bench.state(page, "fix", "tracking");
  for (const button of ["#here", "#relocalize", "#edit"]) assert.ok(await page.isVisible(button), button);
  assert.deepEqual(page.problems, []);

  await bench.stop(bench.web);
  await bench.serve("--private", "--token-file", bench.path("token"));
  await page.goto(bench.url);
  await until("the token is asked for", async () => (await page.textContent("#away")).includes("?token="));
  await page.goto(`${bench.url}/?token=${token}`);
  await bench.state(page, "fix", "tracking");
}));

test("the name of a room within another is seen; theta is in degrees too", withBench(async (bench) => {
  const box = (x, y, w, h) => [[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
  const rooms = [{ name: "nook", polygon: box(1.9, 1.2, 0.4, 0.4) }, { name: "hall", polygon: box(0, 0, 3, 2) }];
  await bench.start(bench.write("room.json", { ...symmetricRoom, rooms }), { args: ["--pose", "0.4,0.4,0.4"] });
  const page = await bench.browse(sizes.phone);
  await bench.state(page, "ambiguous");
  const at = await onScreen(page, [2.1, 1.4]);
  const colors = await page.$eval("#map", (canvas, { x, y }) => {
    const ratio = canvas.width / canvas.clientWidth;
    const { data } = canvas.getContext("2d").getImageData((x - 12) * ratio, (y - 10) * ratio, 24, 12);
    return new Set(new Uint32Array(data.buffer)).size;
  }, at);
  assert.ok(colors > 3, `${colors} colours where the name is`);
  assert.ok(await page.$eval("#degrees", (one) => getComputedStyle(one).display !== "none"));
}));
