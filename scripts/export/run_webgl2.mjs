// Opens docs/examples/export/webgl2.html in Debian's Chromium, without a window and on software GL, and writes what it
// drew. usage: node run_webgl2.mjs TOOLS PAGE FOLDER DISTANCE PIXELS OUT.pfm
import { createReadStream, existsSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { join, normalize, resolve } from 'node:path';

const [tools, page, folder, distance, pixels, out] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(tools), 'package.json'))('playwright-core');

const server = createServer((request, response) => {
  const path = normalize(new URL(request.url, 'http://localhost').pathname);
  const file = path === '/page' ? page : join(folder, path.replace(/^\/export\//, ''));
  if (!existsSync(file)) return response.writeHead(404).end();
  response.setHeader('Content-Type', path === '/page' ? 'text/html' : 'application/octet-stream');
  createReadStream(file).pipe(response);
}).listen(0, '127.0.0.1');
await new Promise(done => server.on('listening', done));

const browser = await chromium.launch({
  executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
try {
  const tab = await browser.newPage();
  const errors = [];
  tab.on('pageerror', error => errors.push(error.message));
  await tab.goto(`http://127.0.0.1:${server.address().port}/page?export&${distance}&${pixels}`);
  await tab.waitForFunction('window.picture', null, { timeout: 60000 }).catch(error => {
    throw new Error(errors.join('; ') || error.message);
  });
  const rgba = await tab.evaluate(() => Array.from(window.picture));
  const rgb = new Float32Array(rgba.filter((_, i) => i % 4 < 3));
  writeFileSync(out, Buffer.concat([Buffer.from(`PF\n${pixels} ${pixels}\n-1.0\n`), Buffer.from(rgb.buffer)]));
} catch (error) {
  console.log(`webgl2: ${error.message.split('\n')[0]}`);
  process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
