// SPDX-License-Identifier: MIT
// cornerd-mqtt as the master controller of vda-5050-lib sees it, and the page of a fleet.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { join } from "node:path";
import vda from "vda-5050-lib";
import { freePort, sizes, tree, until, withBench } from "./bench.mjs";

const { BlockingType, MasterController, Topic } = vda;
const map = readFileSync(join(tree, "config/maps/krpai-2019-a.json"), "utf8");
const agv = { manufacturer: "acme", serialNumber: "r-1" };

async function startFleet(bench) {
  const port = await freePort();
  bench.broker = `127.0.0.1:${port}`;
  bench.write("broker.conf", `listener ${port} 127.0.0.1\nallow_anonymous true\npersistence false\nuser root\n`);
  bench.run("/usr/sbin/mosquitto", ["-c", bench.path("broker.conf")]);
  bench.write("map.json", map);
  bench.emulate(bench.path("map.json"), "--pose", "0.95,0.6,1.57");
  await until("the emulator's port", () => bench.emulator.output.length > 0);
  bench.config(bench.path("map.json"));
  bench.startDaemon();
  await bench.serve("--broker", bench.broker);
  const config = bench.write("mqtt.json", { broker: { host: "127.0.0.1", port }, vda5050: "2.0",
    robot: { manufacturer: agv.manufacturer, serial: agv.serialNumber }, site: { map: "hall", map_folder: bench.folder },
    socket: { pose: bench.path("pose.sock"), control: bench.path("control.sock") } });
  bench.bridge = () => bench.run("cornerd-mqtt", ["--config", config]);
}

test("a master controller accepts every message by schema, and moves the robot", withBench(async (bench) => {
  await startFleet(bench);
  const master = new MasterController({ interfaceName: "uagv", vdaVersion: "2.0.0",
    transport: { brokerUrl: `mqtt://${bench.broker}` }, topicObjectValidation: { inbound: true, outbound: true } }, {});
  await until("the master connects", () => master.start().then(() => true, () => false));
  const seen = {};
  for (const topic of [Topic.State, Topic.Visualization, Topic.Connection, Topic.Factsheet]) {
    await master.subscribe(topic, agv, (object) => (seen[topic] ??= []).push(object));
  }
  const bridge = bench.bridge();
  await until("a position", () => seen.state?.some((state) => state.agvPosition.positionInitialized));

  const act = (actionId, x) => new Promise((done) => master.initiateInstantActions(agv, { instantActions: [{
    actionType: "initPosition", actionId, blockingType: BlockingType.None, actionParameters: Object.entries(
      { x, y: 0.6, theta: 1.57, mapId: "", lastNodeId: "n1" }).map(([key, value]) => ({ key, value })) }] },
  { onActionStateChanged: ({ actionStatus, resultDescription }) => actionStatus !== "RUNNING" && done({ actionStatus, resultDescription }),
    onActionError: (error) => done(error) }));
  assert.equal((await act("right", 0.9)).actionStatus, "FINISHED");
  const refused = await act("far", 99);
  assert.equal(refused.actionStatus, "FAILED");
  assert.match(refused.resultDescription, /outside/);
  await until("the reached node", () => seen.state.at(-1).lastNodeId === "n1");

  await until("visualizations", () => seen.visualization?.length > 20);
  // What does not fit its schema is dropped: then a number is missing.
  for (const [topic, objects] of Object.entries(seen)) {
    objects.slice(1).forEach((object, i) => assert.equal(object.headerId, objects[i].headerId + 1, topic));
  }
  assert.equal(seen.factsheet.length, 1);
  assert.deepEqual(seen.connection.map(({ connectionState }) => connectionState), ["ONLINE"]);
  bridge.child.kill("SIGKILL");
  await until("the last will", () => seen.connection.at(-1).connectionState === "CONNECTIONBROKEN");
  await master.stop();
}));

test("a published map is on the robot, and the robot on the page of the fleet", withBench(async (bench) => {
  await startFleet(bench);
  bench.bridge();
  bench.write("next.json", `${map}\n// the next version\n`);
  const publish = () => bench.call("cornerctl", ["map", "publish", bench.path("next.json"), "--name", "hall", "--broker", bench.broker]);
  const told = await until("the map is published", async () => {
    const { code, output } = await publish();
    return code === 0 && output;
  });
  assert.match(told, /hall version 1/);
  assert.match((await publish()).output, /is this map/);
  const page = await bench.browse(sizes.desk);
  await page.goto(`${bench.url}/fleet.html`);
  await until("the robot with the map", async () => /acme\/r-1.*fix.*hall 1/s.test(await page.textContent("#rows")));
  const drawn = () => page.evaluate(() => {
    const { width, height } = document.getElementById("map");
    return new Set(document.getElementById("map").getContext("2d").getImageData(0, 0, width, height).data).size;
  });
  await until("walls and a robot", async () => await drawn() > 3);
  assert.equal(await page.isVisible("#away"), false);
  let loads = 0;
  page.on("response", (response) => { loads += response.url().includes("/api/fleet/map") && response.ok(); });
  bench.write("next.json", `${map}\n// the version after it\n`);
  assert.match((await publish()).output, /hall version 2/);
  await until("the page has the newer map", () => loads === 1);
  if (process.env.SCREENSHOTS) await page.screenshot({ path: join(process.env.SCREENSHOTS, "fleet.png") });
  assert.deepEqual(page.problems, []);
}));
