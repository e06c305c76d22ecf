// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { test } from "node:test";
import { join } from "node:path";
import { sizes, sleep, tree, until, withBench } from "./bench.mjs";

const kTolerance_px = 2;
const map = join(tree, "config/maps/krpai-2019-a.json");
const drive = { args: ["--path", "0.36,1.1 0.36,0.24 0.95,0.24 0.95,1.15 1.6,1.15", "--loop", "--drive-speed", "0.2",
  "--acceleration", "0.25", "--rotation-speed", "0.6", "--rotation-acceleration", "1"] };

// The middle of the pixels of the robot's colour, in pixels of the page, with what they were drawn from.
const findRobot = (page) => page.$eval("#map", (canvas) => {
  const { width, height, dataset } = canvas;
  const color = getComputedStyle(document.documentElement).getPropertyValue("--robot").trim();
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  let n = 0, x = 0, y = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i] !== r || data[i + 1] !== g || data[i + 2] !== b || data[i + 3] !== 255) continue;
    n += 1;
    x += i / 4 % width + 0.5;
    y += Math.floor(i / 4 / width) + 0.5;
  }
  const ratio = width / canvas.clientWidth;
  return n && { n, x: x / n / ratio, y: y / n / ratio, t: Number(dataset.t), center: [Number(dataset.x), Number(dataset.y)],
    scale: Number(dataset.scale), middle: [canvas.clientWidth / 2, canvas.clientHeight / 2] };
});

test("the drawn robot is where the emulated one is, at both sizes", withBench(async (bench) => {
  await bench.start(map, drive);
  const pages = [await bench.browse(sizes.desk), await bench.browse(sizes.phone, true)];
  for (const page of pages) await bench.state(page, "fix", "tracking");
  const seen = [[], []];
  for (let i = 0; i < 60; ++i) {
    for (const k of [0, 1]) {
      // One of them follows the robot, the other shows the whole map.
      if (i === 30 && k === 1) await pages[1].click("#follow");
      const robot = await findRobot(pages[k]);
      if (robot) seen[k].push(robot);
    }
    await sleep(120);
  }
  for (const page of pages) assert.deepEqual(page.problems, []);
  await bench.stop(bench.emulator);
  const truth = bench.truth();
  for (const [k, robots] of seen.entries()) {
    const times = new Set(robots.map((robot) => robot.t));
    assert.ok(times.size > 30, `${times.size} different poses were drawn`);
    let worst = 0;
    for (const robot of robots) {
      assert.ok(robot.n > 100, `a disc of ${robot.n} pixels`);
      const { x, y } = truth(robot.t);
      const at = [robot.middle[0] + (x - robot.center[0]) * robot.scale, robot.middle[1] - (y - robot.center[1]) * robot.scale];
      worst = Math.max(worst, Math.hypot(robot.x - at[0], robot.y - at[1]));
    }
    console.log(`${Object.keys(sizes)[1 - k]}: ${robots.length} pictures of ${times.size} poses, at most ${worst.toFixed(2)} px off`);
    assert.ok(worst < kTolerance_px, `${worst} px off`);
  }
}));

test("a daemon that is killed and started again is followed within 3 s", withBench(async (bench) => {
  await bench.start(map, { args: ["--pose", "0.95,0.6,1.57"] });
  const page = await bench.browse(sizes.desk);
  await bench.state(page, "fix", "tracking");
  bench.daemon.child.kill("SIGKILL");
  await bench.daemon.ended;
  await page.waitForSelector("#away:not([hidden])");
  const before = await page.$eval("#map", (canvas) => canvas.dataset.t);
  bench.startDaemon();
  await until("the daemon's first pose", async () => {
    const status = await bench.call("cornerctl", ["status", "--socket", bench.path("pose.sock")]);
    return /"state":"(fix|tracking)"/.test(status.output);
  });
  const began = Date.now();
  await until("a new pose is drawn", async () =>
    await page.$eval("#map", (canvas) => canvas.dataset.t) > before && !(await page.isVisible("#away")), 3000);
  console.log(`followed ${Date.now() - began} ms after the daemon's first pose`);
}));

test("record, and the last minute, are recordings", withBench(async (bench) => {
  await bench.start(map, { args: ["--pose", "0.95,0.6,1.57"] });
  const page = await bench.browse(sizes.phone);
  await bench.state(page, "fix", "tracking");
  await page.click("#record");
  await sleep(2000);
  for (const button of ["#record", "#minute"]) {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    const file = bench.path(`${button.slice(1)}.ndjson`);
    await download.saveAs(file);
    const replayed = await bench.call("cornerctl", ["replay", file, "--map", map]);
    assert.equal(replayed.code, 0, replayed.errors);
    assert.ok(replayed.output.split('"class":"POSE"').length > 8, `poses of ${button}`);
  }
}));

test("the scan is drawn from where the lidar sits on the robot", withBench(async (bench) => {
  await bench.start(map, { args: ["--pose", "0.95,0.6,1.57"] }, { mount: { x: -0.3, y: 0.2, theta: 2 } });
  const page = await bench.browse(sizes.desk);
  await bench.state(page, "fix", "tracking");
  const share = () => page.$eval("#map", (canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const style = getComputedStyle(document.documentElement);
    const [known, unknown] = ["--scan", "--unexplained"].map((name) => {
      const color = style.getPropertyValue(name).trim();
      const [r, g, b] = [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));
      let n = 0;
      for (let i = 0; i < data.length; i += 4) n += data[i] === r && data[i + 1] === g && data[i + 2] === b;
      return n;
    });
    return known / (known + unknown);
  });
  await until("the scan lies on the walls", async () => await share() > 0.95, 10000);
}));
