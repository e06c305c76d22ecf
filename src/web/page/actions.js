// SPDX-License-Identifier: MIT
// What changes something: requests to the daemon and to cornerd-web.

const token = new URLSearchParams(location.search).get("token");

// A path with the token, where a browser sets no headers.
export const withToken = (path) => token ? `${path}${path.includes("?") ? "&" : "?"}token=${encodeURIComponent(token)}` : path;

// { ok, answer }: the daemon's answer, or { message } with what went wrong.
async function send(method, path, body) {
  const headers = { "Content-Type": "application/json" };
  if (token) headers.Authorization = `Bearer ${token}`;
  try {
    const response = await fetch(path, { method, headers, body });
    const answer = await response.json().catch(() => ({ message: `refused (${response.status})` }));
    return { ok: response.ok, answer };
  } catch {
    return { ok: false, answer: { message: "no connection to cornerd-web" } };
  }
}

// The daemon's refusal in words; empty if it agreed.
export async function request(message) {
  const { ok, answer } = await send("POST", "/api/request", JSON.stringify(message));
  return ok ? "" : answer.message;
}
export const setPose = ({ x, y, theta }) => request({ class: "SET_POSE", x, y, theta });
export const relocalize = () => request({ class: "RELOCALIZE" });

export const checkMap = (map) => send("POST", "/api/maps/check", JSON.stringify(map));
export const saveMap = (name, map) => send("PUT", `/api/maps/${encodeURIComponent(name)}`, JSON.stringify(map, null, 1));
export const useMap = (file) => request({ class: "SET_MAP", file });
