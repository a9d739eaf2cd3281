// Opens a report in headless Chromium, as people see it, and drags the edge of a slider.
//   node page_test.mjs NODE_MODULES PAGE.html SCREENSHOT_FOLDER
import { createRequire } from "node:module";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, page_path, screenshots] = process.argv.slice(2).map((path) => resolve(path));
const { chromium } = createRequire(join(modules, "any.js"))("playwright-core");
let failures = 0;
function expect(holds, claim) {
  if (holds) return;
  console.log(`expected: ${claim}`);
  ++failures;
}

const profile = mkdtempSync(join(tmpdir(), "redmap-page-"));
const browser = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  viewport: { width: 1240, height: 900 },
  colorScheme: "light",
  timeout: 180_000,  // a sanitizer's tests beside it can hold both cores
});
try {
  const page = await browser.newPage();
  page.setDefaultTimeout(180_000);
  const asked = [], complaints = [];
  page.on("request", (request) => asked.push(request.url()));
  page.on("console", (message) => complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(pathToFileURL(page_path).href);

  expect(complaints.length === 0, `no complaint of the browser, found ${complaints}`);
  const outside = asked.filter((url) => !url.startsWith("file:") && !url.startsWith("data:"));
  expect(outside.length === 0, `nothing asked of a network, found ${outside}`);
  expect((await page.locator("section").count()) > 2, "a section for each figure");
  expect((await page.locator("tbody tr").count()) > 2, "tables with rows");
  expect((await page.locator("svg path").count()) > 0, "curves");
  const broken = await page.locator("img").evaluateAll((all) => all.filter((image) => !image.naturalWidth).length);
  expect(broken === 0, `every picture to be decoded, found ${broken} broken`);

  // The edge follows the pointer: at the far right only the left picture is seen, at the far left only the right one.
  const stage = page.locator(".stage").first();
  await stage.scrollIntoViewIfNeeded();
  const box = await stage.boundingBox();
  const middle = box.y + box.height / 2;
  const drag = async (to) => {
    await page.mouse.move(box.x + box.width / 2, middle);
    await page.mouse.down();
    await page.mouse.move(box.x + to * box.width, middle, { steps: 4 });
    await page.mouse.up();
    return Number(await stage.getAttribute("aria-valuenow"));
  };
  const quarter = await drag(0.25);
  expect(Math.abs(quarter - 25) < 2, `the edge at 25 % after dragging it there, found ${quarter}`);
  expect((await drag(1.1)) === 100, "the edge to stop at the right");
  const left = await stage.screenshot();
  expect((await drag(-0.1)) === 0, "the edge to stop at the left");
  const right = await stage.screenshot();
  expect(!left.equals(right), "another picture on the other side of the edge");
  await stage.focus();
  await page.keyboard.press("ArrowRight");
  expect((await stage.getAttribute("aria-valuenow")) === "2", "the arrow keys to move the edge");
  await page.locator(".slider select.left").first().selectOption({ index: 1 });
  await drag(1.1);
  expect(!(await stage.screenshot()).equals(left), "another left picture after choosing it");
  await drag(0.5);

  // Loops move, and stop at a click.
  const loop = page.locator(".loop").first();
  const place = () => loop.locator("img").evaluate((image) => getComputedStyle(image).transform);
  const seen = new Set();
  for (let i = 0; i < 100 && seen.size < 3; ++i) {  // a slow machine shows few of the frames, and late
    seen.add(await place());
    await page.waitForTimeout(130);
  }
  expect(seen.size > 2, `loops to move, found ${seen.size} places`);
  await loop.click();
  const stopped = await place();
  await page.waitForTimeout(400);
  expect((await place()) === stopped, "a loop to stop at a click");

  // Light and dark, wide and narrow: nothing sticks out.
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await background();
  await page.screenshot({ path: join(screenshots, "light.png"), fullPage: true });
  await page.emulateMedia({ colorScheme: "dark" });
  expect((await background()) !== light, "another background in dark mode");
  await page.screenshot({ path: join(screenshots, "dark.png"), fullPage: true });
  for (const width of [1240, 390]) {
    await page.setViewportSize({ width, height: 900 });
    const needed = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(needed <= width, `a page no wider than ${width}, found ${needed}`);
  }
  await page.screenshot({ path: join(screenshots, "narrow.png"), fullPage: true });
} finally {
  await browser.close();
  rmSync(profile, { recursive: true, force: true });
}
process.exit(failures === 0 ? 0 : 1);
