// SPDX-License-Identifier: MIT
// Fingers and mouse on the canvas. `mode(p)`: { drag, release, cancel } for one finger that
// is pressed at p of the map, or null: it moves the picture. Two fingers and the wheel zoom.

const kTap_px = 4;

export function listenToFingers(canvas, view, mode, tap, onPan) {
  const fingers = new Map();
  let moved = 0, active = null;
  const at = (event) => ({ x: event.offsetX, y: event.offsetY });
  const point = (event) => { const p = view.toMap(at(event)); return [p.x, p.y]; };
  const cancel = () => { active?.cancel?.(); active = null; };

  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
    if (fingers.size > 1) return cancel();
    moved = 0;
    active = mode(point(event));
  };
  canvas.onpointermove = (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = at(event);
    moved += Math.hypot(now.x - before.x, now.y - before.y);
    if (fingers.size === 2) {
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, one]) => one);
      const span = (p) => Math.hypot(p.x - other.x, p.y - other.y);
      view.zoom(span(now) / Math.max(1, span(before)), { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
      view.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
    } else if (active) {
      active.drag?.(point(event));
    } else if (moved > kTap_px) {
      onPan();
      view.pan(now.x - before.x, now.y - before.y);
    }
    fingers.set(event.pointerId, now);
  };
  canvas.onpointerup = (event) => {
    const alone = fingers.size === 1;
    fingers.delete(event.pointerId);
    if (active) active.release?.(point(event), moved <= kTap_px);
    else if (alone && moved <= kTap_px) tap(at(event));
    active = null;
  };
  canvas.onpointercancel = (event) => {
    fingers.delete(event.pointerId);
    cancel();
  };
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoom(Math.exp(-event.deltaY / 500), at(event));
  }, { passive: false });
}
