// SPDX-License-Identifier: MIT
// What changes something: requests to the daemon.

const token = new URLSearchParams(location.search).get("token");

// The daemon's answer in words; empty if it agreed.
export async function request(message) {
  const headers = { "Content-Type": "application/json" };
  if (token) headers.Authorization = `Bearer ${token}`;
  try {
    const response = await fetch("/api/request", { method: "POST", headers, body: JSON.stringify(message) });
    if (response.ok) return "";
    const answer = await response.json();
    return answer.message ?? `refused (${response.status})`;
  } catch {
    return "no connection to cornerd-web";
  }
}

export const setPose = ({ x, y, theta }) => request({ class: "SET_POSE", x, y, theta });
export const relocalize = () => request({ class: "RELOCALIZE" });
