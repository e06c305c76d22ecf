// SPDX-License-Identifier: MIT
// All robots of a site on one of its maps.
import { withToken } from "./actions.js";
import { color, wallPaths } from "./walls.js";

const $ = (id) => document.getElementById(id);
const kOld_s = 15;  // a robot that stands still reports every 10 s
const canvas = $("map"), context = canvas.getContext("2d");
let robots = [], maps = [], map = null, loaded = "", version = 0;

const get = (path) => fetch(withToken(path), { signal: AbortSignal.timeout(2000) });
const ageText = (s) => s < 120 ? `${s.toFixed(0)} s` : s < 7200 ? `${(s / 60).toFixed(0)} min` : `${(s / 3600).toFixed(0)} h`;

async function loadMap() {
  const name = $("choice").value, announced = maps.find((one) => one.name === name)?.version;
  if (name === loaded && announced === version) return;
  const response = await get(`/api/fleet/map?name=${encodeURIComponent(name)}`).catch(() => null);
  if (!response?.ok) return;
  map = await response.json();
  loaded = name;
  version = announced;
}

function cell(row, text, small) {
  const td = row.insertCell();
  td.textContent = text;
  if (small) td.appendChild(document.createElement("small")).textContent = small;
}

function showRows() {
  const rows = robots.map((robot) => {
    const row = document.createElement("tr");
    row.classList.toggle("old", robot.age > kOld_s);
    cell(row, `${robot.manufacturer}/${robot.serial}`, robot.problem);
    cell(row, robot.state);
    cell(row, robot.room ?? "");
    cell(row, robot.map + (robot.map_version ? ` ${robot.map_version}` : ""));
    cell(row, ageText(robot.age));
    return row;
  });
  $("rows").replaceChildren(...rows);
}

function draw() {
  const ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const shown = robots.filter((robot) => robot.x !== undefined && (!loaded || robot.map === loaded));
  const points = [...(map?.walls ?? []).flatMap((wall) => [wall.from, wall.to]), ...shown.map((robot) => [robot.x, robot.y])];
  if (!points.length) return;
  const bound = (i, best) => points.reduce((so_far, point) => best(so_far, point[i]), points[0][i]);
  const low = [bound(0, Math.min), bound(1, Math.min)], high = [bound(0, Math.max), bound(1, Math.max)];
  const scale = 0.9 * Math.min(width / (high[0] - low[0] + 0.5), height / (high[1] - low[1] + 0.5));
  context.setTransform(ratio * scale, 0, 0, -ratio * scale, ratio * (width - scale * (low[0] + high[0])) / 2, ratio * (height + scale * (low[1] + high[1])) / 2);
  if (map) {
    context.fillStyle = context.strokeStyle = color("wall");
    context.lineWidth = 1 / scale;
    const paths = wallPaths(map.walls, map.thickness ?? 0);
    context.fill(paths);
    context.stroke(paths);
  }
  for (const robot of shown) {
    const size = 9 / scale, { x, y, theta } = robot;
    context.globalAlpha = robot.age > kOld_s ? 0.3 : 1;
    context.fillStyle = color(robot.localized ? "tracking" : "lost");
    context.beginPath();
    for (const [ahead, left] of [[1.4, 0], [-1, 0.8], [-1, -0.8]]) {
      context.lineTo(x + size * (ahead * Math.cos(theta) - left * Math.sin(theta)), y + size * (ahead * Math.sin(theta) + left * Math.cos(theta)));
    }
    context.fill();
  }
  // Names upright, in pixels.
  const { a, d, e, f } = context.getTransform();
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.font = `${12 * ratio}px sans-serif`;
  context.fillStyle = color("wall");
  context.globalAlpha = 1;
  for (const robot of shown) context.fillText(robot.serial, a * robot.x + e + 12 * ratio, d * robot.y + f + 4 * ratio);
}

async function refresh() {
  const response = await get("/api/fleet").catch(() => null);
  const answer = await response?.json().catch(() => null);
  const problem = !answer ? "No connection to cornerd-web. Trying again …" : answer.message ?? (answer.connected ? "" : `No broker: ${answer.problem}`);
  $("away").hidden = !problem;
  $("away").textContent = problem;
  if (answer?.robots) {
    robots = answer.robots;
    maps = answer.maps;
    const names = maps.map(({ name }) => name), options = [...$("choice").options].map((option) => option.value);
    if (names.join() !== options.join()) $("choice").replaceChildren(...names.map((name) => new Option(name)));
    if (names.length) await loadMap();
    showRows();
    draw();
  }
  setTimeout(refresh, 1000);
}

$("choice").onchange = () => loadMap().then(draw);
addEventListener("resize", draw);
refresh();
