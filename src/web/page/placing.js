// SPDX-License-Identifier: MIT
// Points of the lidar into the map: by the pose that holds at the middle of their scan, and the
// lidar's place on the robot. Of pose and scan either may come first.

const kSameTime_s = 0.03;
const kPoses = 10;

export function transform({ x, y, theta }, p) {
  const c = Math.cos(theta), s = Math.sin(theta);
  return { ...p, x: x + c * p.x - s * p.y, y: y + s * p.x + c * p.y };
}

export class ScanPlacer {
  constructor(view) {
    this.view = view;
    this.mount = { x: 0, y: 0, theta: 0 };
    this.poses = [];
  }
  addPose(pose) {
    if (pose.x === undefined) {
      this.poses = [];
      this.view.setScan([]);
      this.view.setCorners([]);
      return;
    }
    this.poses = [pose, ...this.poses].slice(0, kPoses);
    this.place();
  }
  addScan(scan) {
    const points = [];
    scan.ranges.forEach((range, i) => {
      if (range > 0) points.push({ x: range * Math.cos(scan.angles[i]), y: range * Math.sin(scan.angles[i]) });
    });
    this.scan = { t: scan.t + scan.duration / 2, duration: scan.duration, points };
    this.place();
  }
  addBreakpoints({ t, points }) {
    this.breakpoints = { t, points };
    this.place();
  }
  scanIn(base) {
    return (this.scan?.points ?? []).map((p) => transform(base, transform(this.mount, p)));
  }
  place() {
    const poseAt = (t) => this.poses.find((pose) => Math.abs(pose.t - t) < kSameTime_s);
    const { scan, breakpoints } = this;
    const pose = scan && poseAt(scan.t);
    if (pose) this.view.setScan(this.scanIn(pose));
    const then = scan && breakpoints && poseAt(breakpoints.t + scan.duration / 2);
    if (then) this.view.setCorners(breakpoints.points.map((p) => transform(then, transform(this.mount, p))));
  }
}
