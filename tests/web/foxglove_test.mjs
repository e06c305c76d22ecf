// SPDX-License-Identifier: MIT
// Foxglove's own client and MCAP's own reader.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { join } from "node:path";
import protocol from "@foxglove/ws-protocol";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import WebSocket from "ws";
import { tree, until, withBench } from "./bench.mjs";

const { FoxgloveClient } = protocol;
const map = join(tree, "config/maps/krpai-2019-a.json");
const truth = { x: 0.95, y: 0.6, theta: 1.57 };
const mount = { x: 0.04, y: -0.02, theta: 3.1 };
const json = (data) => JSON.parse(new TextDecoder().decode(data));

async function connect(url, name) {
  const messages = {}, told = [];
  let channels, info;
  const client = new FoxgloveClient({ ws: new WebSocket(url, [name]) });
  client.on("error", (error) => { throw error; });
  client.on("serverInfo", (message) => { info = message; });
  client.on("advertise", (all) => { channels = all; });
  client.on("status", (status) => told.push(status.message));
  await until("the channels", () => channels);
  const topics = new Map(channels.map((channel) => [client.subscribe(channel.id), channel]));
  client.on("message", ({ subscriptionId, timestamp, data }) => {
    const { topic } = topics.get(subscriptionId);
    (messages[topic] ??= []).push({ at: Number(timestamp) / 1e9, ...json(data) });
  });
  return { client, info, channels, messages, told };
}

test("the client of @foxglove/ws-protocol gets scan, walls and pose, and sets the pose", withBench(async (bench) => {
  await bench.start(map, { args: ["--pose", `${truth.x},${truth.y},${truth.theta}`] }, { mount });
  const url = `${bench.url.replace("http", "ws")}/foxglove`;
  const { client, info, channels, messages, told } = await connect(url, FoxgloveClient.SUPPORTED_SUBPROTOCOL);
  assert.deepEqual([info.name, info.capabilities], ["cornerd", ["clientPublish"]]);
  for (const channel of channels) JSON.parse(channel.schema);
  await until("scan, walls and pose", () => ["/scan", "/walls", "/pose", "/tf"].every((topic) => messages[topic]));
  await until("scans", () => messages["/scan"].length > 3);

  const scan = messages["/scan"].at(-1);
  assert.equal(scan.frame_id, "lidar");
  assert.equal(scan.ranges.length, scan.intensities.length);
  assert.ok(scan.ranges.filter((range) => range > 0.1 && range < 4).length > 200);
  assert.ok(scan.end_angle - scan.start_angle > 6);
  assert.equal(messages["/walls"].at(-1).entities[0].cubes.length, JSON.parse(readFileSync(map, "utf8").replace(/^\s*\/\/.*$/gm, "")).walls.length);
  const pose = messages["/pose"].at(-1);
  assert.ok(Math.abs(pose.at - Date.now() / 1000) < 30, `${pose.at}`);
  assert.ok(Math.abs(pose.at - pose.timestamp.sec - pose.timestamp.nsec / 1e9) < 1e-6);
  const transform = (child) => messages["/tf"].filter((one) => one.child_frame_id === child).at(-1);
  await until("the mount", () => Math.abs(transform("lidar").translation.x - mount.x) < 1e-6);
  // The lidar is where the emulator has it: on a robot with a mount, the pose of `base` differs.
  const { position: p, orientation: q } = messages["/pose"].at(-1).pose, theta = 2 * Math.atan2(q.z, q.w);
  const lidar = { x: p.x + Math.cos(theta) * mount.x - Math.sin(theta) * mount.y,
    y: p.y + Math.sin(theta) * mount.x + Math.cos(theta) * mount.y };
  assert.ok(Math.hypot(lidar.x - truth.x, lidar.y - truth.y) < 0.02, JSON.stringify(lidar));

  const id = client.advertise({ topic: "/initialpose", encoding: "json", schemaName: "foxglove.PoseInFrame" });
  const publish = (frame) => client.sendMessage(id, new TextEncoder().encode(JSON.stringify({
    timestamp: { sec: 0, nsec: 0 }, frame_id: frame, pose: messages["/pose"].at(-1).pose })));
  publish("moon");
  await until("the refusal", () => told.some((text) => text.includes("frame_id")));
  const refusals = told.length, poses = messages["/pose"].length;
  publish("map");
  await until("later poses", () => messages["/pose"].length > poses + 3);
  assert.deepEqual(told.slice(refusals), []);
  client.close();

  // The same under the SDK's name.
  const again = await connect(url, "foxglove.sdk.v1");
  await until("a pose", () => again.messages["/pose"]);
  again.client.close();
}));

test("a foreign page's WebSocket, and one of no known protocol, are refused", withBench(async (bench) => {
  await bench.serve();
  const answer = (protocols, options) => new Promise((done) => {
    const socket = new WebSocket(`${bench.url.replace("http", "ws")}/foxglove`, protocols, options);
    socket.on("unexpected-response", (_, response) => done(response.statusCode));
    socket.on("open", () => done("open"));
    socket.on("error", () => {});
  });
  assert.equal(await answer(["foxglove.sdk.v1"], { origin: "http://evil.example" }), 403);
  assert.equal(await answer(["foxglove.sdk.v1"], { headers: { host: "evil.example" } }), 403);
  assert.equal(await answer(["mqtt"], {}), 426);
  assert.equal(await answer(["foxglove.sdk.v1"], {}), "open");
}));

test("@mcap/core reads an export: as many messages as in the recording", withBench(async (bench) => {
  const bytes = bench.path("drive.bin"), lines = bench.path("drive.ndjson"), mcap = bench.path("drive.mcap");
  const simulated = await bench.call("cornerctl", ["simulate", "--map", map, "--path", "0.36,1.1 0.36,0.24 0.95,0.24", "-o", bytes]);
  assert.equal(simulated.code, 0, simulated.errors);
  const replayed = await bench.call("cornerctl", ["replay", bytes, "--map", map, "--classes", "POSE,SCAN,STATUS,MAP"]);
  writeFileSync(lines, replayed.output);
  const count = (name) => replayed.output.split(`{"class":"${name}"`).length - 1;
  const read = async () => {
    const file = readFileSync(mcap), counts = {};
    const reader = await McapIndexedReader.Initialize({ readable: {
      size: async () => BigInt(file.length),
      read: async (offset, size) => new Uint8Array(file.buffer, file.byteOffset + Number(offset), Number(size)) } });
    for await (const message of reader.readMessages()) {
      const { topic } = reader.channelsById.get(message.channelId);
      counts[topic] = (counts[topic] ?? 0) + 1;
      json(message.data);
    }
    const total = Object.values(counts).reduce((a, b) => a + b);
    assert.equal(reader.statistics.messageCount, BigInt(total));
    const stream = new McapStreamReader({ validateCrcs: true });
    stream.append(file);
    let streamed = 0;
    for (let record; (record = stream.nextRecord());) streamed += record.type === "Message";
    assert.equal(streamed, total);
    return counts;
  };
  assert.equal((await bench.call("cornerctl", ["export", lines, "-o", mcap])).code, 0);
  const counts = await read();
  assert.ok(count("SCAN") > 5);
  assert.deepEqual([counts["/scan"], counts["/cornerd/pose"], counts["/cornerd/status"], counts["/walls"]],
    [count("SCAN"), count("POSE"), count("STATUS"), count("MAP")]);
  // The bytes of the port alone: the scans in them.
  assert.equal((await bench.call("cornerctl", ["export", bytes, "-o", mcap])).code, 0);
  assert.deepEqual(await read(), { "/scan": count("SCAN") });
}));
