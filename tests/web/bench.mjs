// SPDX-License-Identifier: MIT
// What the tests start: an emulated A1, cornerd, cornerd-web and a browser; all end with the test.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const bin = process.env.CORNERD_BIN;
export const tree = process.env.CORNERD_TREE;
export const sizes = { phone: { width: 390, height: 844 }, desk: { width: 1280, height: 800 } };
// Looks the same after half a turn.
export const symmetricRoom = { format: "cornerd-map", version: 1, name: "room", thickness: 0.1, walls: [
  { from: [0, 0], to: [3, 0] }, { from: [3, 0], to: [3, 2] }, { from: [3, 2], to: [0, 2] }, { from: [0, 2], to: [0, 0] }] };
const kPatience_ms = 30000;

export const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

// Repeats until `ask` gives something true; what it gave.
export async function until(what, ask, patience = kPatience_ms) {
  const end = Date.now() + patience;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`not within ${patience / 1000} s: ${what}`);
    await sleep(50);
  }
}

export async function freePort() {
  const server = createServer();
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const { port } = server.address();
  await new Promise((done) => server.close(done));
  return port;
}

export class Bench {
  constructor() {
    this.folder = mkdtempSync(join(tmpdir(), "cornerd-web-"));
    this.processes = [];
  }
  path(name) { return join(this.folder, name); }
  write(name, content) {
    writeFileSync(this.path(name), typeof content === "string" ? content : JSON.stringify(content));
    return this.path(name);
  }
  run(program, args) {
    const child = spawn(program.startsWith("/") ? program : join(bin, program), args, { stdio: ["ignore", "pipe", "pipe"] });
    const one = { child, output: "", errors: "", ended: new Promise((done) => child.on("close", done)) };
    child.stdout.on("data", (data) => { one.output += data; });
    child.stderr.on("data", (data) => { one.errors += data; });
    this.processes.push(one);
    return one;
  }
  // The end of a program that ends by itself.
  async call(program, args) {
    const one = this.run(program, args);
    return { code: await one.ended, output: one.output, errors: one.errors };
  }
  async stop(one) {
    one.child.kill("SIGTERM");
    await one.ended;
  }

  emulate(map, ...args) {
    this.emulator = this.run("cornerctl", ["emulate", "--map", map, "--link", this.path("lidar"),
      "--truth", this.path("truth.ndjson"), ...args]);
    return this.emulator;
  }
  config(map, lidar = {}) {
    return this.write("cornerd.json", {
      map, lidar: { device: this.path("lidar"), ...lidar },
      socket: { pose: this.path("pose.sock"), control: this.path("control.sock") },
      advanced: { realtime: { priority: 0, lock_memory: false } } });
  }
  startDaemon() { this.daemon = this.run("cornerd", ["--config", this.path("cornerd.json")]); }
  async serve(...args) {
    this.port = await freePort();
    this.web = this.run("cornerd-web", ["--listen", `127.0.0.1:${this.port}`, "--pose", this.path("pose.sock"),
      "--control", this.path("control.sock"), "--maps", this.folder, ...args]);
    await until("cornerd-web listens", () => this.web.errors.includes("http://"));
    this.url = `http://127.0.0.1:${this.port}`;
  }
  async start(map, emulated, lidar = {}) {
    this.emulate(emulated.map ?? map, ...emulated.args);
    await until("the emulator's port", () => this.emulator.output.length > 0);
    this.config(map, lidar);
    this.startDaemon();
    await this.serve();
  }
  // x, y, theta at a time, as the emulator wrote it: complete when the emulator has ended.
  truth() {
    const points = readFileSync(this.path("truth.ndjson"), "utf8").trim().split("\n").map((line) => JSON.parse(line));
    return (t) => {
      const next = points.findIndex((point) => point.t >= t);
      if (next < 1) return null;
      const [a, b] = [points[next - 1], points[next]];
      const share = (t - a.t) / (b.t - a.t || 1);
      return { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
    };
  }

  async browse(size, dark = false) {
    this.browser ??= await chromium.launch({
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
        "--disable-background-networking", "--disable-component-update"] });
    const context = await this.browser.newContext({ viewport: size, colorScheme: dark ? "dark" : "light",
      hasTouch: size.width < 600, acceptDownloads: true });
    const page = await context.newPage();
    page.problems = [];
    page.on("pageerror", (error) => page.problems.push(String(error)));
    page.on("request", (request) => request.url().startsWith(this.url) || request.url().startsWith("blob:") || request.url().startsWith("data:") || page.problems.push(request.url()));
    await page.goto(this.url);
    return page;
  }
  async state(page, ...states) {
    await until(`the state is ${states}`, async () => states.includes(await page.textContent("#state")));
  }

  async end() {
    await this.browser?.close();
    for (const one of this.processes.reverse()) {
      if (one.child.exitCode === null && one.child.signalCode === null) one.child.kill("SIGKILL");
      await one.ended;
    }
    rmSync(this.folder, { recursive: true, force: true });
  }
}

// Runs `body(bench)`, and says what the programs said where it fails.
export const withBench = (body) => async () => {
  const bench = new Bench();
  try {
    await body(bench);
  } catch (error) {
    for (const { child, errors } of bench.processes) console.error(child.spawnargs[0], errors.slice(-2000));
    throw error;
  } finally {
    await bench.end();
  }
};

// In pixels of the page, where the map has [x, y].
export const onScreen = (page, [x, y]) => page.$eval("#map", (canvas, [mx, my]) => ({
  x: canvas.clientWidth / 2 + (mx - canvas.dataset.x) * canvas.dataset.scale,
  y: canvas.clientHeight / 2 - (my - canvas.dataset.y) * canvas.dataset.scale }), [x, y]);
