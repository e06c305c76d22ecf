// SPDX-License-Identifier: MIT
// Who may not, and who sends too much.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { connect } from "node:net";
import { test } from "node:test";
import { join } from "node:path";
import { sleep, tree, until, withBench } from "./bench.mjs";

const map = join(tree, "config/maps/krpai-2019-a.json");
const still = { args: ["--pose", "0.95,0.6,1.57"] };
const kMemory_KiB = 24 * 1024;
const token = "0123456789abcdef0123";

const memory = (bench) => Number(/VmRSS:\s*(\d+)/.exec(readFileSync(`/proc/${bench.web.child.pid}/status`, "utf8"))[1]);
// Without fetch(), which forbids some headers.
const ask = (bench, text) => new Promise((done) => {
  let answer = "";
  const socket = connect(bench.port, "127.0.0.1", () => socket.write(text));
  socket.on("data", (data) => { answer += data; });
  socket.on("error", () => done(answer));
  socket.on("close", () => done(answer));
});
const head = (line, ...headers) => [`${line} HTTP/1.1`, "Connection: close", ...headers, "", ""].join("\r\n");
const status = async (bench, ...request) => Number((await ask(bench, head(...request))).split(" ")[1]);

test("promtool is content with /metrics", withBench(async (bench) => {
  await bench.start(map, still);
  await until("a pose", async () => (await (await fetch(`${bench.url}/metrics`)).text()).includes("cornerd_pose_x_meters"));
  const text = await (await fetch(`${bench.url}/metrics`)).text();
  const checked = spawnSync("promtool", ["check", "metrics"], { input: text, encoding: "utf8" });
  assert.equal(checked.status, 0, checked.stdout + checked.stderr);
  assert.equal(checked.stdout + checked.stderr, "");
}));

test("foreign names and pages get 403, what changes something needs JSON and the token", withBench(async (bench) => {
  await bench.serve("--token-file", bench.write("token", `${token}\n`));
  const own = `Host: 127.0.0.1:${bench.port}`;
  assert.equal(await status(bench, "GET /", own), 200);
  for (const path of ["/", "/api/status", "/api/events", "/metrics", "/foxglove"]) {
    assert.equal(await status(bench, `GET ${path}`, "Host: evil.example"), 403, path);
    assert.equal(await status(bench, `GET ${path}`, own, "Origin: http://evil.example"), 403, path);
  }
  const post = (...headers) => status(bench, "POST /api/request", own, "Content-Length: 0", ...headers);
  assert.equal(await post("Content-Type: application/json"), 401);
  assert.equal(await post("Content-Type: text/plain", `Authorization: Bearer ${token}`), 415);
  assert.equal(await post("Content-Type: application/json", "Origin: http://evil.example", `Authorization: Bearer ${token}`), 403);
  assert.equal(await post("Content-Type: application/json", `Authorization: Bearer ${token}`), 409);
  assert.equal(await status(bench, "GET /api/maps", own), 200);

  await bench.stop(bench.web);
  await bench.serve("--private", "--token-file", bench.path("token"));
  const again = `Host: 127.0.0.1:${bench.port}`;
  assert.equal(await status(bench, "GET /", again), 200);  // the page itself tells nothing
  assert.equal(await status(bench, "GET /api/maps", again), 401);
  assert.equal(await status(bench, "GET /metrics", again), 401);
  assert.equal(await status(bench, "GET /foxglove", again), 401);
  assert.equal(await status(bench, `GET /api/maps?token=${token}`, again), 200);
}));

test("garbage, readers that stall and a huge upload cost neither memory nor poses", withBench(async (bench) => {
  await bench.start(map, still);
  const host = `Host: 127.0.0.1:${bench.port}`;
  let poses = [], rest = "";
  const socket = connect(bench.path("pose.sock"));
  socket.on("data", (data) => {
    const lines = (rest + data).split("\n");
    rest = lines.pop();
    for (const line of lines) {
      const message = JSON.parse(line);
      if (message.class === "POSE") poses.push({ ...message, late: Date.now() / 1000 - message.t });
    }
  });
  const median = () => poses.map((pose) => pose.late).sort((a, b) => a - b)[poses.length >> 1];
  await until("poses", () => poses.length > 20);
  const quiet = median(), before = memory(bench);
  poses = poses.slice(-1);

  const streams = Array.from({ length: 50 }, (_, i) => {
    const stream = connect(bench.port, "127.0.0.1");
    stream.write(head("GET /api/events?classes=POSE,SCAN,MAP,STATUS", host));
    stream.on("error", () => {});
    i < 10 ? stream.pause() : stream.resume();
    return stream;
  });
  const garbage = ["\xff\xfe\x00 garbage\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", head("GET /%zz", host), head("FLY /", host),
    head("GET /api/events?classes=,,,", "Host: "), `GET /${"a".repeat(9000)} HTTP/1.1\r\n\r\n`,
    head("POST /api/request", host, "Content-Type: application/json", "Transfer-Encoding: chunked") + "zz\r\n",
    head("POST /api/request", host, "Content-Type: application/json", "Content-Length: 9") + '{"class":', "\r\n".repeat(50)];
  let most = before, sent = 0;
  await Promise.all(Array.from({ length: 8 }, async () => {
    while (sent < 10000) {
      const text = garbage[sent++ % garbage.length];
      await Promise.race([ask(bench, text), sleep(20)]);
      if (sent % 500 === 0) most = Math.max(most, memory(bench));
    }
  }));
  const upload = async (headers, piece) => {
    let bytes = 0, closed = false;
    const one = connect(bench.port, "127.0.0.1");
    one.on("error", () => { closed = true; });
    one.on("close", () => { closed = true; });
    one.resume();
    one.write(headers);
    while (!closed && bytes < 1e9) {
      bytes += piece.length;
      if (!one.write(piece)) await Promise.race([new Promise((done) => one.once("drain", done)), sleep(200)]);
      most = Math.max(most, memory(bench));
    }
    one.destroy();
    return bytes;
  };
  const json = "Content-Type: application/json";
  const chunk = `10000\r\n${" ".repeat(0x10000)}\r\n`;
  const lengths = await Promise.all([
    upload(head("PUT /api/maps/huge", host, json, "Content-Length: 1000000000"), " ".repeat(0x10000)),
    upload(head("POST /api/maps/check", host, json, "Transfer-Encoding: chunked"), chunk)]);
  for (const bytes of lengths) assert.ok(bytes < 2e7, `${bytes} bytes of 1 GB were taken`);
  most = Math.max(most, memory(bench));
  console.log(`memory: ${before} KiB, at most ${most} KiB; a pose is ${(1000 * quiet).toFixed(0)} ms old on the socket, ` +
    `${(1000 * median()).toFixed(0)} ms meanwhile (${poses.length} poses); uploads were cut after ${lengths} bytes`);
  assert.ok(most < kMemory_KiB, `${most} KiB`);
  poses.forEach((pose, i) => i && assert.equal(pose.seq, poses[i - 1].seq + 1, "no pose is lost"));
  assert.equal(await status(bench, "GET /", host), 200);
  for (const stream of streams) stream.destroy();
  socket.destroy();
}));

test("a map of many walls is passed on", withBench(async (bench) => {
  const walls = Array.from({ length: 20000 }, (_, i) => {
    const [x, y] = [3 * (i % 150), 3 * Math.floor(i / 150)];
    return i % 2 ? { from: [x, y], to: [x + 1.5, y] } : { from: [x, y], to: [x, y + 2.1] };
  });
  const large = bench.write("large.json", { format: "cornerd-map", version: 1, name: "large", thickness: 0.1, walls });
  await bench.start(large, { map, ...still });
  await until("the map", async () => (await fetch(`${bench.url}/api/map`)).status === 200, 60000);
  const before = memory(bench);
  const answer = await (await fetch(`${bench.url}/api/map`)).json();
  assert.equal(answer.walls.length, walls.length);
  console.log(`memory with a map of ${walls.length} walls: ${before} KiB`);
  assert.ok(memory(bench) < kMemory_KiB, `${memory(bench)} KiB`);
}));
