// The server under test: the real `gsv run` or `gsv replay` of this build, on a port that the system
// chooses.
//
// GSV_BUILD_DIR     the build whose bin/gsv is started
// GSV_RUN_COMMAND   another command than `gsv run`, as a shell would take it, that prints the viewer's
//                   address
import { spawn } from "node:child_process";
import { once } from "node:events";
import path from "node:path";
import process from "node:process";
import { withTimeout } from "./browser.mjs";

const START_TIMEOUT_MS = 90_000;
const RECORD_TIMEOUT_MS = 120_000;
const STOP_TIMEOUT_MS = 30_000;
const ADDRESS = /http:\/\/127\.0\.0\.1:(\d+)\//;

// Starts the server with these arguments after `run`. `url` is the viewer's address.
export async function startServer(args = []) {
  return start(["run", ...args]);
}

// Starts `gsv serve` with these arguments, without a simulation.
export async function startServe(args) {
  return start(["serve", ...args]);
}

// Starts `gsv replay` with these arguments.
export async function startReplay(args) {
  return start(["replay", ...args]);
}

// Starts `gsv view` with these arguments (a relay).
export async function startView(args) {
  return start(["view", ...args]);
}

// Runs gsv with these arguments until it ends.
export async function gsv(args) {
  const child = spawn(program(), args, { stdio: "inherit" });
  const [code] = await withTimeout(once(child, "exit"), STOP_TIMEOUT_MS, `the end of gsv ${args[0]}`);
  if (code !== 0) throw new Error(`gsv ${args.join(" ")} ended with ${code}`);
}

// Runs and records a simulation without a viewer until it ends.
export async function record(file, args) {
  const child = spawn(program(), ["run", ...args, "--headless", "--record", file], {
    stdio: ["ignore", "ignore", "pipe"],
    detached: true,
  });
  let complaints = "";
  child.stderr.setEncoding("utf8").on("data", (chunk) => (complaints += chunk));
  try {
    const [code] = await withTimeout(once(child, "exit"), RECORD_TIMEOUT_MS, "the recorded run's end");
    if (code !== 0) throw new Error(`the recorded run ended with ${code}:\n${complaints}`);
  } catch (error) {
    if (child.exitCode === null) process.kill(-child.pid, "SIGKILL");
    throw error;
  }
}

async function start(command) {
  const server = new Server(command);
  await server.start(0);
  return server;
}

export function program() {
  const build = process.env.GSV_BUILD_DIR;
  if (!build) throw new Error("GSV_BUILD_DIR must name the build whose bin/gsv is tested");
  return path.join(build, "bin", "gsv");
}

class Server {
  constructor(command) {
    this.command = command;
  }

  // The port stays the same after a restart, for pages that are still open.
  async restart() {
    const port = Number(new URL(this.url).port);
    await this.stop();
    await this.start(port);
  }

  async start(port) {
    const [program, ...args] = this.commandLine(port);
    this.child = spawn(program, args, { stdio: ["ignore", "pipe", "pipe"], detached: true });
    this.output = "";
    const address = new Promise((resolve, reject) => {
      const read = (chunk) => {
        this.output += chunk;
        const found = ADDRESS.exec(this.output);
        if (found) resolve(found[0]);
      };
      this.child.stdout.setEncoding("utf8").on("data", read);
      this.child.stderr.setEncoding("utf8").on("data", read);
      this.child.on("error", reject);
      this.child.on("exit", (code) => reject(new Error(`the server ended with ${code}:\n${this.output}`)));
    });
    this.url = await withTimeout(address, START_TIMEOUT_MS, "the server's address");
  }

  // Ends the server like Ctrl-C, and returns its exit code. If the server does not end in time,
  // kills it and throws an error.
  async stop() {
    const { child } = this;
    if (child.exitCode !== null || child.signalCode !== null) return child.exitCode;
    const exit = once(child, "exit");
    child.kill("SIGINT");
    try {
      const [code] = await withTimeout(exit, STOP_TIMEOUT_MS, "the server's end after SIGINT");
      return code;
    } catch (error) {
      process.kill(-child.pid, "SIGKILL"); // the process group, which includes its behaviours
      throw error;
    }
  }

  // Kills the server and its behaviours, like a crash.
  async kill() {
    const exit = once(this.child, "exit");
    process.kill(-this.child.pid, "SIGKILL");
    await withTimeout(exit, STOP_TIMEOUT_MS, "the killed server's end");
  }

  commandLine(port) {
    const other = process.env.GSV_RUN_COMMAND;
    if (other && this.command[0] === "run") return [...other.split(" "), "--port", String(port)];
    return [program(), ...this.command, "--port", String(port)];
  }
}
