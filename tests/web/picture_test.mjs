// SPDX-License-Identifier: MIT
// The pictures of the README, where SCREENSHOTS names a folder.
import { test } from "node:test";
import { join } from "node:path";
import { sizes, sleep, symmetricRoom, tree, withBench } from "./bench.mjs";

const folder = process.env.SCREENSHOTS;

test("pictures", { skip: !folder }, withBench(async (bench) => {
  const map = join(tree, "config/maps/flat-7.json");
  await bench.start(map, { args: ["--path", "1.2,2.6 1.4,0.9 3.3,0.9 3.3,2.2", "--drive-speed", "0.35", "--clutter", "0.05", "--loop"] });
  const desk = await bench.browse(sizes.desk), phone = await bench.browse(sizes.phone, true);
  await bench.state(desk, "fix", "tracking");
  await sleep(9000);
  await desk.screenshot({ path: join(folder, "page.png") });
  await phone.click("#follow");
  await sleep(500);
  await phone.screenshot({ path: join(folder, "phone.png") });
  await desk.click("#edit");
  await sleep(1000);
  await desk.screenshot({ path: join(folder, "editor.png") });
}));

test("a picture of ghosts", { skip: !folder }, withBench(async (bench) => {
  await bench.start(bench.write("hall.json", symmetricRoom), { args: ["--pose", "1.1,0.8,0.4"] });
  const phone = await bench.browse(sizes.phone);
  await bench.state(phone, "ambiguous");
  await sleep(500);
  await phone.screenshot({ path: join(folder, "ghosts.png") });
}));
