// A proxy in front of a server. It can slow down the server's answers like a slow network. Like
// routers and proxies, it buffers data that it cannot forward yet. The buffers of its sockets contain
// megabytes.
import net from "node:net";
import { setTimeout } from "node:timers/promises";

const CHUNKS_PER_SECOND = 20;

// The server must allow this host. The proxy uses the port number of the server on this host,
// because browsers send the port in the Host header.
export const SLOW_HOST = "127.0.0.2";

// Opens the proxy. At first there is no limit; `limit(bytesPerSecond)` sets one for each connection,
// and 0 passes nothing.
export async function openSlowLink(serverUrl) {
  const upstream = new URL(serverUrl);
  const sockets = new Set();
  let bytesPerSecond = Infinity;

  const pass = async (from, to) => {
    for await (const data of from) {
      for (let at = 0; at < data.length && !to.destroyed; ) {
        if (bytesPerSecond === 0) {
          await setTimeout(1000 / CHUNKS_PER_SECOND);
          continue;
        }
        const size = Number.isFinite(bytesPerSecond) ? Math.max(1, Math.round(bytesPerSecond / CHUNKS_PER_SECOND)) : data.length;
        const chunk = data.subarray(at, at + size);
        at += chunk.length;
        to.write(chunk);
        if (Number.isFinite(bytesPerSecond)) await setTimeout((1000 * chunk.length) / bytesPerSecond);
      }
    }
    to.end();
  };

  const proxy = net.createServer((client) => {
    const server = net.connect({ host: upstream.hostname, port: Number(upstream.port) });
    for (const socket of [client, server]) {
      sockets.add(socket);
      socket.setNoDelay(true);
      socket.on("error", () => {}).on("close", () => sockets.delete(socket));
    }
    client.pipe(server);
    client.on("close", () => server.destroy());
    pass(server, client).catch(() => client.destroy());
  });
  await new Promise((resolve) => proxy.listen(Number(upstream.port), SLOW_HOST, resolve));
  return {
    url: `http://${SLOW_HOST}:${upstream.port}/`,
    limit: (rate) => (bytesPerSecond = rate),
    close: () => {
      for (const socket of sockets) socket.destroy();
      return new Promise((resolve) => proxy.close(resolve));
    },
  };
}
