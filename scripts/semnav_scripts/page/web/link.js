// The connection to the server: one WebSocket, which sends requests and hands on what comes.

/** Open the connection. `heed` maps the type of a message to a function of it. */
export function connect(heed) {
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  const socket = new WebSocket(`${scheme}://${location.host}/session`);
  socket.binaryType = "blob";
  socket.onmessage = ({ data }) => {
    if (data instanceof Blob) return heed.film(data);
    const message = JSON.parse(data);
    heed[message.type](message);
  };
  socket.onclose = () => heed.closed();
  return (type, values = {}) => {
    if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ type, ...values }));
  };
}
