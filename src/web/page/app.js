// SPDX-License-Identifier: MIT
// Start here: messages into the view and the panel, fingers into requests.
import { relocalize, setPose } from "./actions.js";
import { follow } from "./live.js";
import { View } from "./view.js";

const $ = (id) => document.getElementById(id);
const view = new View($("map"));

const meanings = {
  fix: "this scan names the place",
  tracking: "this scan and those before name the place",
  predicted: "odometry alone",
  ambiguous: "several places fit: tap the right one",
  lost: "no place fits",
};

function tell(text) {
  $("told").textContent = text;
  clearTimeout(tell.timer);
  tell.timer = setTimeout(() => { $("told").textContent = ""; }, 5000);
}

function showPose(pose) {
  $("state").textContent = pose.state;
  $("state").dataset.state = pose.state;
  $("meaning").textContent = meanings[pose.state] + (pose.state !== "predicted" || pose.age === undefined ? "" : ` for ${pose.age.toFixed(1)} s`);
  const known = pose.x !== undefined;
  $("x").textContent = known ? pose.x.toFixed(3) : "–";
  $("y").textContent = known ? pose.y.toFixed(3) : "–";
  $("theta").textContent = known ? pose.theta.toFixed(3) : "–";
  $("degrees").textContent = known ? `${(pose.theta * 180 / Math.PI).toFixed(1)}°` : "";
  $("sigma").textContent = pose.cov ? `${(1000 * Math.sqrt(pose.cov.xx + pose.cov.yy)).toFixed(1)} mm` : "–";
  $("place").textContent = [pose.room, pose.map].filter(Boolean).join(", ");
}

function showStatus(status) {
  $("hint").textContent = status.hint ?? "";
  const parts = [`lidar ${status.lidar?.state ?? "unknown"}`];
  if (status.lidar?.rate_hz) parts.push(`${status.lidar.rate_hz.toFixed(1)} scans/s`);
  if (status.latency?.p99 !== undefined) parts.push(`latency p99 ${(1000 * status.latency.p99).toFixed(1)} ms`);
  $("rates").textContent = parts.join(" · ");
}

// A pose holds at the middle of its scan; either of the two messages may come first.
let poses = [], scan = null, breakpoints = null;
function place(message, t, points) {
  const pose = message && poses.find((one) => Math.abs(one.t - t) < 0.03);
  if (!pose) return null;
  const c = Math.cos(pose.theta), s = Math.sin(pose.theta);
  return points.map((p) => ({ ...p, x: pose.x + c * p.x - s * p.y, y: pose.y + s * p.x + c * p.y }));
}
function placeScan() {
  const points = place(scan, scan && scan.t + scan.duration / 2, scan?.points);
  if (points) view.setScan(points);
  const corners = place(breakpoints, breakpoints && breakpoints.t + (scan?.duration ?? 0) / 2, breakpoints?.points);
  if (corners) view.setCorners(corners);
}

follow({
  away: (reason) => {
    $("away").hidden = reason === null;
    $("away").textContent = reason ?? "";
  },
  MAP: (map) => view.setMap(map),
  POSE: (pose) => {
    showPose(pose);
    view.setPose(pose);
    if (pose.x === undefined) {
      view.setScan([]);
      view.setCorners([]);
      return;
    }
    poses = [pose, ...poses].slice(0, 10);
    placeScan();
  },
  SCAN: (message) => {
    const points = [];
    message.ranges.forEach((range, i) => {
      if (range > 0) points.push({ x: range * Math.cos(message.angles[i]), y: range * Math.sin(message.angles[i]) });
    });
    scan = { ...message, points };
    placeScan();
  },
  BREAKPOINTS: (message) => {
    breakpoints = message;
    placeScan();
  },
  STATUS: showStatus,
  // The last event comes at the start too, and may be from yesterday.
  EVENT: (event) => poses[0] && Math.abs(event.t - poses[0].t) < 5 && tell([event.what, event.detail].filter(Boolean).join(": ")),
});

async function sendPose(pose) {
  const problem = await setPose(pose);
  tell(problem || `told the daemon: ${pose.x.toFixed(2)}, ${pose.y.toFixed(2)}`);
}

function setFollowing(on) {
  view.following = on;
  $("follow").setAttribute("aria-pressed", on);
  if (on && view.pose) view.setPose(view.pose);
}
function setAiming(on) {
  $("here").setAttribute("aria-pressed", on);
  $("map").classList.toggle("aiming", on);
  if (on) tell("press where the robot is, drag to where it looks");
  view.aim = null;
  view.draw();
}
const isAiming = () => $("here").getAttribute("aria-pressed") === "true";

$("follow").onclick = () => setFollowing(!view.following);
$("whole").onclick = () => { setFollowing(false); view.showWhole(); };
$("here").onclick = () => setAiming(!isAiming());
$("relocalize").onclick = async () => tell(await relocalize() || "searching the whole map");
addEventListener("keydown", (event) => {
  if (event.key === "f") setFollowing(!view.following);
  if (event.key === "m") $("whole").click();
  if (event.key === "Escape") setAiming(false);
});

// One finger moves the map or aims, two zoom it; a tap on a ghost takes it.
const fingers = new Map();
let moved = 0;
const canvas = $("map");
canvas.onpointerdown = (event) => {
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  moved = 0;
  if (isAiming() && fingers.size === 1) {
    view.aim = { ...view.toMap({ x: event.offsetX, y: event.offsetY }), theta: 0 };
    view.draw();
  }
};
canvas.onpointermove = (event) => {
  const before = fingers.get(event.pointerId);
  if (!before) return;
  const now = { x: event.offsetX, y: event.offsetY };
  moved += Math.hypot(now.x - before.x, now.y - before.y);
  if (view.aim) {
    const to = view.toMap(now);
    view.aim.theta = Math.atan2(to.y - view.aim.y, to.x - view.aim.x);
    view.draw();
  } else if (fingers.size === 2) {
    const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    const span = (p) => Math.hypot(p.x - other.x, p.y - other.y);
    view.zoom(span(now) / Math.max(1, span(before)), { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
  } else if (moved > 4) {
    setFollowing(false);
    view.pan(now.x - before.x, now.y - before.y);
  }
  fingers.set(event.pointerId, now);
};
canvas.onpointerup = canvas.onpointercancel = (event) => {
  const at = { x: event.offsetX, y: event.offsetY };
  fingers.delete(event.pointerId);
  if (event.type === "pointercancel") return setAiming(false);
  if (view.aim) {
    const pose = view.aim;
    setAiming(false);
    sendPose(pose);
  } else if (moved <= 4) {
    const ghost = view.ghostAt(at);
    if (ghost) sendPose(ghost);
  }
};
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  view.zoom(Math.exp(-event.deltaY / 500), { x: event.offsetX, y: event.offsetY });
}, { passive: false });
