// What the viewer page costs before its first picture: bytes over the wire and time, in Debian's Chromium on software GL,
// nothing cached. usage: node measure_page.mjs TOOLS ADDRESS [RUNS], with ADDRESS of a running `redmap view --web`
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';

const [tools, address, runs = '3'] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(tools), 'package.json'))('playwright-core');
for (let run = 0; run < Number(runs); ++run) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  await page.goto(address);
  await page.waitForFunction(() => document.body.dataset.state === 'shown', null, { timeout: 300000 });
  const [first, loaded] = await page.evaluate(() => ['redmap-first-picture', 'redmap-loaded'].map(
    name => performance.getEntriesByName(name)[0].startTime));
  const entries = await page.evaluate(() => performance.getEntries().filter(entry => entry.transferSize > 0).map(
    ({ name, transferSize }) => [new URL(name).pathname, transferSize]));
  if (run === 0) for (const [name, count] of entries) console.log(`${String(count).padStart(9)}  ${name}`);
  const sum = entries.reduce((all, [, count]) => all + count, 0);
  console.log(`${(sum / 1e6).toFixed(2)} MB, all loaded after ${loaded.toFixed(0)} ms, first picture after ${first.toFixed(0)} ms`);
  await browser.close();
}
