// Chromium for the tests, and what several of them look at. Environment: BREACH_BROWSER_BUILD (node_modules and
// screenshots live there).
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

export const build_folder = process.env.BREACH_BROWSER_BUILD;
const { chromium } = createRequire(path.join(build_folder, "package.json"))("playwright-core");

const switches = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
                  "--disable-component-update", "--disable-sync"];

/// A page in a new, empty profile. close() ends the browser and removes the profile.
export async function open_browser({ width = 1400, height = 900 } = {}) {
    const profile = mkdtempSync(path.join(build_folder, "profile-"));
    const context = await chromium.launchPersistentContext(profile, {
        executablePath: "/usr/bin/chromium", headless: true, args: switches, viewport: { width, height },
    });
    const page = context.pages()[0];
    const complaints = [];
    const foreign = [];
    page.on("pageerror", (fault) => complaints.push(fault.stack));
    page.on("request", (request) => {
        const { hostname, protocol } = new URL(request.url());
        if (protocol.startsWith("http") && hostname !== "127.0.0.1") foreign.push(request.url());
    });
    const close = async () => {
        await context.close();
        rmSync(profile, { recursive: true, force: true });
    };
    return { page, complaints, foreign, close };
}

export async function screenshot(page, name) {
    const folder = path.join(build_folder, "screenshots");
    mkdirSync(folder, { recursive: true });
    await page.evaluate(() => window.scrollTo(0, 0));
    await page.screenshot({ path: path.join(folder, `${name}.png`), fullPage: true });
}

/// What the particle canvas shows inside its axes: share of pixels that are soil, number of different colours, share of
/// the soil in the two commonest ones (outlines blend into a few others), and a sum that changes when the picture does.
export function canvas_facts(page, id = "view") {
    return page.evaluate((wanted) => {
        const canvas = document.getElementById(wanted);
        const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        const ground = data.slice(0, 3).join();
        const colours = new Map();
        let soil = 0;
        let sum = 0;
        for (let i = 0; i < data.length; i += 4) {
            const [red, green, blue] = [data[i], data[i + 1], data[i + 2]];
            const is_grey = Math.max(red, green, blue) - Math.min(red, green, blue) < 30;
            if (is_grey || `${red},${green},${blue}` === ground) continue; // ground, axes, outlines
            soil += 1;
            const colour = (red << 16) | (green << 8) | blue;
            colours.set(colour, (colours.get(colour) ?? 0) + 1);
            sum = (sum + (i % 65521) * (red + 3 * green + 7 * blue)) % 4294967291;
        }
        const [first = 0, second = 0] = [...colours.values()].sort((a, b) => b - a);
        return { share: soil / (width * height), colours: colours.size, two_commonest: (first + second) / soil, sum };
    }, id);
}

/// Waits until probe() is true; says what was waited for when it never is.
export async function until(what, probe, limit = 20000) {
    const end = Date.now() + limit;
    for (;;) {
        if (await probe()) return;
        if (Date.now() > end) throw new Error(`waited ${limit / 1000} s in vain: ${what}`);
        await new Promise((resume) => setTimeout(resume, 100));
    }
}

/// Opens the run by its address, as a link of the page does, and waits until every part of the page is its own. What a person chose in
/// the run before stays chosen.
export async function open_run(page, url, id) {
    if (!page.url().startsWith(`${url}/`)) await page.goto(`${url}/`);
    await page.evaluate((wanted) => { location.hash = `#/runs/${wanted}`; }, id);
    await until("all parts", () => page.evaluate((wanted) => document.querySelector("#run-list a[aria-current]")?.hash === `#/runs/${wanted}` &&
        document.querySelectorAll("#run > .coming").length === 0 && document.getElementById("run").checkVisibility(), id));
}
