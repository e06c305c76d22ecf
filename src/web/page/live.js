// SPDX-License-Identifier: MIT
// The daemon's messages, for as long as the page is open.
import { withToken } from "./actions.js";

const classes = "POSE,SCAN,BREAKPOINTS,STATUS,EVENT,MAP";

// Calls on.POSE(message) and so on, on.line(text), and on.away(reason), with null when the daemon is
// there, and on.access(may_change).
export function follow(on) {
  let source;
  const open = () => {
    source = new EventSource(withToken(`/api/events?classes=${classes}`));
    source.onmessage = (event) => {
      const message = JSON.parse(event.data);
      on.line(event.data, message.class);
      on[message.class]?.(message);
    };
    source.addEventListener("daemon", (event) => {
      const { connected } = JSON.parse(event.data);
      on.away(connected ? null : "The daemon is away. Waiting for it …");
    });
    source.addEventListener("access", (event) => on.access(JSON.parse(event.data).may_change));
    source.onerror = async () => {
      // A browser gives up after some errors, and waits for long after others.
      source.close();
      on.away("No connection to cornerd-web. Trying again …");
      // The error does not say whether it is the token.
      const response = await fetch(withToken("/api/maps"), { signal: AbortSignal.timeout(1000) }).catch(() => null);
      if (response?.status === 401) on.away("This page needs the token: open it with ?token=T at the end of its address.");
      setTimeout(open, 1000);
    };
  };
  open();
  return () => source.close();
}

// What comes between start() and stop(), after the map and the last STATUS: for cornerctl replay and
// export.
export class Recording {
  lines = null;
  last = {};
  add(text, name) {
    this.last[name] = text;
    this.lines?.push(text, "\n");
  }
  start() {
    this.lines = ["MAP", "STATUS"].filter((name) => this.last[name]).flatMap((name) => [this.last[name], "\n"]);
  }
  stop() {
    const file = new Blob(this.lines, { type: "application/x-ndjson" });
    this.lines = null;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(file);
    link.download = `cornerd-${new Date().toISOString().slice(0, 19).replace(/[:T]/g, "-")}.ndjson`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }
}
