// SPDX-License-Identifier: MIT
// The daemon's messages, for as long as the page is open.

const classes = "POSE,SCAN,BREAKPOINTS,STATUS,EVENT,MAP";

// Calls on.POSE(message) and so on, and on.away(reason), with null when the daemon is there.
export function follow(on) {
  let source;
  const open = () => {
    source = new EventSource(`/api/events?classes=${classes}`);
    source.onmessage = (event) => {
      const message = JSON.parse(event.data);
      on[message.class]?.(message);
    };
    source.addEventListener("daemon", (event) => {
      const { connected } = JSON.parse(event.data);
      on.away(connected ? null : "The daemon is away. Waiting for it …");
    });
    source.onerror = () => {
      on.away("No connection to cornerd-web. Trying again …");
      // A browser gives up after some errors, and waits for long after others.
      source.close();
      setTimeout(open, 1000);
    };
  };
  open();
  return () => source.close();
}
