// SPDX-License-Identifier: MIT
// Start here: messages into the view and the panel, fingers into requests.
import { relocalize, setPose, withToken } from "./actions.js";
import { Editor } from "./editor.js";
import { listenToFingers } from "./gestures.js";
import { follow, Recording } from "./live.js";
import { showPose, showStatus, tell } from "./panel.js";
import { ScanPlacer, transform } from "./placing.js";
import { View } from "./view.js";

const $ = (id) => document.getElementById(id);
const canvas = $("map");

// What panel and toolbar leave of the canvas.
function free() {
  const panel = $("panel").getBoundingClientRect(), tools = $(document.body.classList.contains("drawing") ? "draft-tools" : "tools").getBoundingClientRect();
  const isBeside = innerWidth > 900;
  return { left: isBeside ? panel.right : 10, top: isBeside ? 10 : panel.bottom + 6, right: innerWidth - 10, bottom: tools.top - 40 };
}

const view = new View(canvas, free);
const placer = new ScanPlacer(view);
const recording = new Recording();

// A draft is in the frame of the map, or in that of the robot where the map is not known: then its
// scan stays the one that it began with.
const editor = new Editor(view, () => {
  const { pose } = view, isHeld = !pose;
  const base = pose ?? { x: 0, y: 0, theta: 0 };
  if (isHeld) view.setScan(placer.scanIn(base));
  const lidar = transform(base, placer.mount);
  return { isHeld, lidar: [lidar.x, lidar.y], scan: view.points.map((p) => [p.x, p.y]) };
}, tell);
new ResizeObserver(() => view.isFitted && view.showWhole()).observe($("panel"));

follow({
  away: (reason) => {
    $("away").hidden = reason === null;
    $("away").textContent = reason ?? "";
  },
  access: (mayChange) => document.body.classList.toggle("read-only", !mayChange),
  line: (text, name) => recording.add(text, name),
  MAP: (map) => view.setMap(map),
  POSE: (pose) => {
    showPose(pose);
    view.setPose(pose);
    placer.addPose(pose);
    editor.refresh();
  },
  SCAN: (scan) => placer.addScan(scan),
  BREAKPOINTS: (breakpoints) => placer.addBreakpoints(breakpoints),
  STATUS: (status) => {
    showStatus(status);
    placer.mount = status.lidar?.mount ?? placer.mount;
  },
  // The panel shows the state. The last event comes at the start too, and may be from yesterday.
  EVENT: (event) => event.what !== "state change" && view.pose && Math.abs(event.t - view.pose.t) < 5 && tell([event.what, event.detail].filter(Boolean).join(": ")),
});

async function sendPose(pose) {
  const problem = await setPose(pose);
  tell(problem || `told the daemon: ${pose.x.toFixed(2)}, ${pose.y.toFixed(2)}`);
}

function setFollowing(on) {
  view.follow(on);
  $("follow").setAttribute("aria-pressed", on);
}
function setAiming(on) {
  $("here").setAttribute("aria-pressed", on);
  canvas.classList.toggle("aiming", on);
  if (on) tell("press where the robot is, drag to where it looks");
  view.aim = null;
  view.draw();
}
const isAiming = () => $("here").getAttribute("aria-pressed") === "true";
const aim = ([x, y]) => {
  view.aim = { x, y, theta: 0 };
  view.draw();
  return {
    drag: (to) => {
      view.aim.theta = Math.atan2(to[1] - y, to[0] - x);
      view.draw();
    },
    release: () => {
      const pose = view.aim;
      setAiming(false);
      sendPose(pose);
    },
    cancel: () => setAiming(false),
  };
};

$("follow").onclick = () => setFollowing(!view.following);
$("whole").onclick = () => { setFollowing(false); view.showWhole(); };
$("here").onclick = () => setAiming(!isAiming());
$("relocalize").onclick = async () => tell(await relocalize() || "searching the whole map");
$("minute").href = withToken($("minute").getAttribute("href"));
$("record").onclick = () => {
  const on = recording.lines === null;
  on ? recording.start() : recording.stop();
  $("record").setAttribute("aria-pressed", on);
  tell(on ? "recording" : "recorded: see the browser's downloads");
};
$("edit").onclick = () => {
  setFollowing(false);
  setAiming(false);
  editor.start(view.pose ? view.map : null);
};
addEventListener("keydown", (event) => {
  if (event.target.tagName === "INPUT") return;
  if (event.key === "f") setFollowing(!view.following);
  if (event.key === "m") $("whole").click();
  if (event.key === "z" && (event.ctrlKey || event.metaKey) && editor.isOpen) $("undo").click();
  if (event.key === "Escape") editor.isOpen ? editor.choose("move") : setAiming(false);
});

listenToFingers(canvas, view, (p) => {
  if (isAiming()) return aim(p);
  return editor.isOpen ? editor.gesture(p) : null;
}, (at) => {
  const ghost = view.ghostAt(at);
  if (ghost && !document.body.classList.contains("read-only")) sendPose(ghost);
}, () => view.following && setFollowing(false));
