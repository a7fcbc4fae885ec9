// The real orchestrator for a test. Environment: BREACH_BIN (the built programs).
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import path from "node:path";
import { createInterface } from "node:readline";

export function program(name) {
    const file = path.join(process.env.BREACH_BIN, name);
    assert.ok(existsSync(file), `${file} is built`);
    return file;
}

/// Starts the service on a free port, its data in `folder`; its first line says where it listens. {url, stop()}.
export async function start_service(folder, ...options) {
    const service = spawn(program("breachline"), ["serve", "--data", folder, "--port", "0", ...options],
                          { stdio: ["ignore", "pipe", "inherit"] });
    const lines = createInterface({ input: service.stdout });
    const first = await Promise.race([
        new Promise((resume) => lines.once("line", resume)),
        new Promise((_, give_up) => service.once("exit", (code) => give_up(new Error(`the service ended: ${code}`)))),
    ]);
    const stop = () => {
        if (service.exitCode !== null) return null;
        const ended = new Promise((resume) => service.once("exit", resume));
        service.kill("SIGTERM");
        return ended;
    };
    return { url: JSON.parse(first).url.replace(/\/$/, ""), stop };
}
