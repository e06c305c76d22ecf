// SPDX-License-Identifier: MIT
// The robot, and where else it may be.
import { color } from "./walls.js";

// With the ellipse of its covariance.
export function paintRobot(c, view, { x, y, theta, cov }) {
  const at = view.toScreen({ x, y });
  c.save();
  c.translate(at.x, at.y);
  if (cov) {
    // 95 % of a normal distribution in the plane: 2.45 sigma.
    const mean = (cov.xx + cov.yy) / 2;
    const spread = Math.hypot((cov.xx - cov.yy) / 2, cov.xy);
    c.save();
    c.rotate(-Math.atan2(2 * cov.xy, cov.xx - cov.yy) / 2);
    c.beginPath();
    const radius = (variance) => Math.max(1, 2.45 * Math.sqrt(Math.max(0, variance)) * view.scale);
    c.ellipse(0, 0, radius(mean + spread), radius(mean - spread), 0, 0, 7);
    c.fillStyle = color("sigma");
    c.fill();
    c.restore();
  }
  c.rotate(-theta);
  c.fillStyle = color("nose");
  c.beginPath();
  c.moveTo(22, 0);
  c.lineTo(6, -9);
  c.lineTo(6, 9);
  c.fill();
  c.beginPath();
  c.arc(0, 0, 9, 0, 7);
  c.fillStyle = color("robot");
  c.fill();
  c.strokeStyle = color("ring");
  c.lineWidth = 2;
  c.stroke();
  c.restore();
}

// A place that the robot may be at as well.
export function paintGhost(c, view, ghost, number) {
  const at = view.toScreen(ghost);
  c.save();
  c.translate(at.x, at.y);
  c.strokeStyle = c.fillStyle = color("ghost");
  c.lineWidth = 2;
  c.beginPath();
  c.arc(0, 0, 14, 0, 7);
  c.moveTo(14 * Math.cos(ghost.theta), -14 * Math.sin(ghost.theta));
  c.lineTo(26 * Math.cos(ghost.theta), -26 * Math.sin(ghost.theta));
  c.stroke();
  c.font = "600 14px system-ui, sans-serif";
  c.textAlign = "center";
  c.textBaseline = "middle";
  c.fillText(String(number), 0, 0);
  c.restore();
}

// Where the robot is said to be, by a drag.
export function paintArrow(c, view, { x, y, theta }) {
  paintRobot(c, view, { x, y, theta });
  const from = view.toScreen({ x, y });
  c.strokeStyle = color("robot");
  c.lineWidth = 3;
  c.beginPath();
  c.moveTo(from.x, from.y);
  c.lineTo(from.x + 60 * Math.cos(theta), from.y - 60 * Math.sin(theta));
  c.stroke();
}
