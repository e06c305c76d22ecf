# SPDX-License-Identifier: MIT
"""Client of cornerd: its messages as dictionaries, one at a time. Standard library only.

    import cornerd
    for message in cornerd.messages(classes=["POSE", "SCAN"]):
        print(message["class"], message.get("x"), message.get("y"))

    cornerd.request({"class": "SET_POSE", "x": 0.4, "y": 1.1, "theta": 0.0})

Units: metres, radians, seconds. A message has the fields of the protocol page; unknown ones come too.
"""
import json
import socket
import time

POSE_SOCKET = "/run/cornerd/pose.sock"
CONTROL_SOCKET = "/run/cornerd/control.sock"

FIRST_RETRY_DELAY_S = 0.2
LARGEST_RETRY_DELAY_S = 5.0


class RequestError(Exception):
    """The daemon refused a request. `code`: the protocol's name of the reason."""

    def __init__(self, answer):
        super().__init__(answer.get("message", "the request was refused"))
        self.code = answer.get("code", "")


class Client:
    """One connection. Raises OSError if nobody listens, or nothing arrives within `timeout` (s)."""

    def __init__(self, path=POSE_SOCKET, timeout=None):
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            self._socket.settimeout(timeout)
            self._socket.connect(path)
        except OSError:
            self._socket.close()
            raise
        self._lines = self._socket.makefile("rb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._lines.close()
        self._socket.close()

    def send(self, message):
        """Sends one request or ODOMETRY, a dictionary."""
        self._socket.sendall(json.dumps(message, separators=(",", ":")).encode() + b"\n")

    def receive(self):
        """The next message; None if the daemon closed the connection. An incomplete line is dropped."""
        line = self._lines.readline()
        return json.loads(line) if line.endswith(b"\n") else None


def messages(path=POSE_SOCKET, classes=None, reconnect=True):
    """Yields the daemon's messages; waits for a daemon that is absent or restarts.

    `classes`: names to WATCH; without them POSE, STATUS and EVENT. POSE is in the frame map; ODOM in
    odom (REP 105), which never jumps: steer by it. Without `reconnect` it ends with the connection, and
    raises OSError if nobody listens.
    """
    delay = FIRST_RETRY_DELAY_S
    while True:
        try:
            with Client(path) as client:
                if classes:
                    client.send({"class": "WATCH", "classes": list(classes)})
                while (message := client.receive()) is not None:
                    delay = FIRST_RETRY_DELAY_S
                    yield message
        except OSError:
            if not reconnect:
                raise
        if not reconnect:
            return
        time.sleep(delay)
        delay = min(2 * delay, LARGEST_RETRY_DELAY_S)


def request(message, path=CONTROL_SOCKET, timeout=10.0):
    """Sends one request and returns its OK. Raises RequestError for an ERROR, OSError without a daemon."""
    with Client(path, timeout) as client:
        client.send(message)
        while (answer := client.receive()) is not None:
            if answer.get("class") == "ERROR":
                raise RequestError(answer)
            if answer.get("class") == "OK":
                return answer
    raise ConnectionError(path + ": the daemon closed the connection before it answered")
