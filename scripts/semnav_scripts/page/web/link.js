// The connection to the server: one WebSocket, which sends requests and hands on what comes.

/** Open the connection. `heed` maps the type of a message to a function of it. */
export function connect(heed) {
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  const socket = new WebSocket(`${scheme}://${location.host}/session`);
  socket.binaryType = "blob";
  socket.onmessage = ({ data }) => {
    if (data instanceof Blob) return heed.file(data);
    const message = JSON.parse(data);
    heed[message.type](message);
  };
  socket.onclose = () => heed.closed();
  const isOpen = () => socket.readyState === WebSocket.OPEN;
  return {
    send(type, values = {}) { if (isOpen()) socket.send(JSON.stringify({ type, ...values })); },
    sendFile(blob) { if (isOpen()) socket.send(blob); },
  };
}
