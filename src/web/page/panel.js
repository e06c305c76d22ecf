// SPDX-License-Identifier: MIT
// Messages in words.

const $ = (id) => document.getElementById(id);

const meanings = {
  fix: "this scan names the place",
  tracking: "this scan and those before name the place",
  predicted: "odometry alone",
  ambiguous: "several places fit: tap the right one",
  lost: "no place fits",
};

let timer;
export function tell(text) {
  $("told").textContent = text;
  clearTimeout(timer);
  timer = setTimeout(() => { $("told").textContent = ""; }, 5000);
}

// A pose that nothing follows says nothing of where the robot is now.
const kOld_s = 2;
let shownAt;
setInterval(() => {
  const age_s = (performance.now() - shownAt) / 1000;
  if (!(age_s > kOld_s)) return;
  $("state").textContent = "no pose";
  $("state").dataset.state = "lost";
  $("meaning").textContent = `since ${age_s.toFixed(0)} s`;
}, 500);

export function showPose(pose) {
  shownAt = performance.now();
  $("state").textContent = pose.state;
  $("state").dataset.state = pose.state;
  const since = pose.state !== "predicted" || pose.age === undefined ? "" : ` for ${pose.age.toFixed(1)} s`;
  const odds = pose.x !== undefined && pose.p_wrong > 0 ? `, wrong once in ${Math.round(1 / pose.p_wrong).toLocaleString("en")}` : "";
  $("meaning").textContent = meanings[pose.state] + since + odds;
  const known = pose.x !== undefined;
  $("x").textContent = known ? pose.x.toFixed(3) : "–";
  $("y").textContent = known ? pose.y.toFixed(3) : "–";
  $("theta").textContent = known ? pose.theta.toFixed(3) : "–";
  $("degrees").textContent = known ? `${(pose.theta * 180 / Math.PI).toFixed(1)}°` : "";
  $("sigma").textContent = pose.cov ? `${(1000 * Math.sqrt(pose.cov.xx + pose.cov.yy)).toFixed(1)} mm` : "–";
  $("place").textContent = [pose.room, pose.map].filter(Boolean).join(", ");
}

export function showStatus(status) {
  $("hint").textContent = status.hint ?? "";
  const parts = [`lidar ${status.lidar?.state ?? "unknown"}`];
  if (status.lidar?.rate_hz) parts.push(`${status.lidar.rate_hz.toFixed(1)} scans/s`);
  const { p50, p99 } = status.latency ?? {};
  if (p99 !== undefined) parts.push(`latency ${(1000 * p50).toFixed(0)} to ${(1000 * p99).toFixed(0)} ms`);
  $("rates").textContent = parts.join(" · ");
}
