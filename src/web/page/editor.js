// SPDX-License-Identifier: MIT
// The map is drawn here: tools of the toolbar on the draft, checked by the daemon's own reader, saved
// and switched to.
import { checkMap, saveMap, useMap } from "./actions.js";
import { distance, Draft } from "./draft.js";

const $ = (id) => document.getElementById(id);
const kReach_px = 14;  // of a finger
const kReach_m = 0.3;   // at most, however small the picture
const kCheckDelay_ms = 300;

const explanations = {
  wall: "Drag a wall. It snaps to right angles, to ends, and to the scan under it.",
  move: "Drag an end or a wall.",
  split: "Tap a wall: there it gets a joint.",
  door: "Drag along a wall, or tap it for a door of 80 cm.",
  room: "Drag a rectangle, or tap corner after corner and the first one again. Tap a room to name it.",
  delete: "Tap a wall, or a room.",
};

export class Editor {
  // `reference()`: { scan, lidar, isHeld } in the frame in which is drawn.
  constructor(view, reference, tell) {
    Object.assign(this, { view, reference, tell, tool: "wall" });
    for (const button of document.querySelectorAll("#draft-tools [data-tool]")) {
      button.onclick = () => this.choose(button.dataset.tool);
    }
    $("undo").onclick = () => { this.draft.undo() ? this.changed() : tell("nothing to undo"); };
    $("new-map").onclick = () => this.start(null);
    $("close-draft").onclick = () => this.stop();
    $("save-map").onclick = () => this.save();
    $("thickness").onchange = () => {
      const cm = Number($("thickness").value);
      if (!(cm >= 0 && cm <= 100)) return this.tell("a wall is 0 to 100 cm thick");
      this.draft.remember();
      this.draft.thickness = cm / 100;
      this.changed();
    };
    $("room-name").oninput = () => {
      this.view.chosenRoom.name = $("room-name").value;
      this.changed();
    };
  }
  get isOpen() { return this.draft !== undefined; }

  // `map`: what to begin with; null: nothing.
  start(map) {
    const before = this.draft;
    this.draft = new Draft(map, before?.thickness);
    Object.assign(this.draft, this.reference());
    this.view.draft = this.draft;
    document.body.classList.add("drawing");
    $("map-name").value = `${map?.name ?? "map"}-${new Date().toISOString().slice(0, 10)}`.replace(/[^\w.-]/g, "-");
    this.choose(map ? "move" : "wall");
    this.changed();
    if (!before || !map) this.view.showWhole();
    this.view.isFitted = false;  // nothing moves under the pencil
  }
  stop() {
    this.draft = this.view.draft = this.view.preview = this.view.outline = undefined;
    document.body.classList.remove("drawing");
    const { map } = this.view;
    if (map) this.view.setWalls(map.walls, map.thickness ?? 0);
    this.view.showWhole();
  }
  // A new scan, where it is not held.
  refresh() {
    if (this.draft && !this.draft.isHeld) Object.assign(this.draft, this.reference());
  }

  choose(tool) {
    this.tool = tool;
    for (const button of document.querySelectorAll("#draft-tools [data-tool]")) {
      button.setAttribute("aria-pressed", button.dataset.tool === tool);
    }
    this.view.outline = [];
    this.name(null);
    $("draft-help").textContent = explanations[tool];
    this.view.draw();
  }
  name(room) {
    this.view.chosenRoom = room;
    $("room-name-line").hidden = !room;
    if (!room) return;
    $("room-name").value = room.name;
    $("room-name").focus();
    $("room-name").select();
  }

  // After each change: the words of `map check`.
  changed() {
    $("thickness").value = Math.round(this.draft.thickness * 1000) / 10;
    this.view.setWalls(this.draft.walls, this.draft.thickness);
    clearTimeout(this.timer);
    this.timer = setTimeout(async () => {
      const draft = this.draft;
      if (!draft) return;
      const { ok, answer } = await checkMap(draft.toMap($("map-name").value));
      if (draft !== this.draft) return;
      $("checked").dataset.state = ok ? "fix" : "lost";
      $("checked").textContent = ok
        ? `${answer.walls} walls, ${answer.corners} corners, ${answer.width.toFixed(2)} x ${answer.height.toFixed(2)} m: a map`
        : answer.message;
    }, kCheckDelay_ms);
  }

  async save() {
    const name = $("map-name").value;
    const { ok, answer } = await saveMap(name, this.draft.toMap(name));
    if (!ok) return this.tell(answer.message);
    const problem = await useMap(answer.file);
    if (problem) return this.tell(`saved as ${answer.file}, not in use: ${problem}`);
    this.tell(`saved as ${name}, in use`);
    this.stop();
  }

  // What a finger that is pressed at `begin` does with the tool that is chosen; null: nothing.
  gesture(begin) {
    const { draft, view } = this;
    const reach = Math.min(kReach_px / view.scale, kReach_m);
    const grip = this.tool === "move" ? draft.grab(begin, reach) : null;
    if (this.tool === "move" && !grip) return null;
    this.isRectangle = false;
    const act = {
      wall: {
        drag: (p) => { view.preview = draft.wallFrom(begin, p, reach); },
        release: (p, isTap) => { if (!isTap) draft.addWall(begin, p, reach); },
      },
      move: {
        drag: (p) => grip.drag(grip, p),
        release: (p, isTap) => isTap || grip.release?.(),
      },
      split: { release: (p) => draft.split(p, reach) || this.tell("no wall there") },
      door: {
        release: (p, isTap) => draft.door(begin, isTap ? begin : p, reach) || this.tell("no wall there"),
      },
      delete: { release: (p) => draft.remove(p, reach) || this.tell("nothing there") },
      room: {
        drag: (p) => { if (!view.outline.length || this.isRectangle) this.outlineTo(begin, p, reach); },
        release: (p, isTap) => (isTap ? this.addCorner(p, reach) : this.isRectangle && this.closeRoom()),
      },
    }[this.tool];
    return {
      drag: (p) => { act.drag?.(p); view.draw(); },
      release: (p, isTap) => {
        view.preview = undefined;
        act.release(p, isTap);
        this.changed();
      },
      cancel: () => { view.preview = undefined; view.draw(); },
    };
  }
  outlineTo(a, b, reach) {
    this.isRectangle = true;
    this.view.outline = this.draft.rectangle(this.draft.snapPoint(a, reach), this.draft.snapPoint(b, reach));
  }
  addCorner(p, reach) {
    const { outline } = this.view;
    const room = outline.length ? null : this.draft.roomAt(p);
    if (room) return this.name(room);
    if (outline.length > 2 && distance(p, outline[0]) < reach) return this.closeRoom();
    outline.push(this.draft.snapPoint(p, reach));
  }
  closeRoom() {
    const room = this.draft.addRoom(this.view.outline);
    this.view.outline = [];
    this.name(room);
  }
}
