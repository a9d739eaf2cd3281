// The viewer page in headless Chromium, on software GL.
//   node web_test.mjs TOOLS ADDRESS FOLDER [short]: with map.png, original.png and supersampled.png by the CPU; screenshots go there
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

const [tools, address, folder, isShort] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(tools), 'any.js'))('playwright-core');
let failures = 0;
function expect(holds, claim) {
  if (holds) return;
  console.log(`expected: ${claim}`);
  ++failures;
}

const common = ['--no-sandbox', '--disable-gpu-sandbox', '--disable-background-networking', '--disable-component-update',
  '--disable-sync'];
const software = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const profile = mkdtempSync(join(tmpdir(), 'chromium-'));
async function open(args, options = {}) {
  return chromium.launchPersistentContext(join(profile, String(args.length)), {
    executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
    args: [...common, ...args],
    colorScheme: 'light',
    ...options,
  });
}

/** A page that counts what it asks for, and what the browser says of it. */
async function watched(context, query = '') {
  const page = await context.newPage();
  page.asked = [], page.complaints = [];
  page.on('request', request => page.asked.push(request.url()));
  page.on('console', message => page.complaints.push(message.text()));
  page.on('pageerror', error => page.complaints.push(String(error)));
  await page.goto(address + query);
  await page.waitForFunction(() => document.body.dataset.state !== 'loading', null, { timeout: 120000 });
  return page;
}
const message = page => page.locator('#message').textContent();

/** The picture alone, without what is written on it. */
async function picture(page) {
  await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
  const style = await page.addStyleTag({ content: '#picture > :not(canvas) { visibility: hidden; }' });
  const png = await page.locator('canvas').screenshot();
  await style.evaluate(element => element.remove());
  return png;
}

/** RMSE of two PNGs in linear light, clamped, over pixels that neither show background nor have it beside them. */
function rmse(page, a, b) {
  return page.evaluate(async ([...pngs]) => {
    const decoded = [];
    for (const png of pngs) {
      const image = new Image();
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      decoded.push(context.getImageData(0, 0, image.width, image.height));
    }
    const linear = byte => (byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
    const { width, height } = decoded[0];
    if (width !== decoded[1].width || height !== decoded[1].height)
      throw new Error(`${width} x ${height} and ${decoded[1].width} x ${decoded[1].height}`);
    const isBackground = i => decoded.some(({ data }) =>
      [0, 1, 2].every(c => Math.abs(data[4 * i + c] - data[c]) <= 1));
    let sum = 0, count = 0;
    for (let y = 1; y + 1 < height; ++y)
      for (let x = 1; x + 1 < width; ++x) {
        const around = [0, 1, -1].flatMap(dy => [0, 1, -1].map(dx => (y + dy) * width + x + dx));
        if (around.some(isBackground)) continue;
        for (let c = 0; c < 3; ++c)
          sum += (linear(decoded[0].data[4 * around[0] + c]) - linear(decoded[1].data[4 * around[0] + c])) ** 2 / 3;
        ++count;
      }
    return { rmse: Math.sqrt(sum / count), count };
  }, [a, b].map(png => png.toString('base64')));
}

/** To that part of the picture's width. */
async function dragLine(page, to) {
  const box = await page.locator('#picture').boundingBox(), line = await page.locator('#divider').boundingBox();
  await page.mouse.move(Math.min(line.x + 16, box.x + box.width - 2), box.y + 40);
  await page.mouse.down();
  await page.mouse.move(box.x + to * box.width, box.y + 40, { steps: 2 });
  await page.mouse.up();
  await page.locator('#picture').focus();
}

async function drawsTheCpusPicture(page) {
  await page.setViewportSize({ width: 256, height: 256 });
  // All of the window for the picture; all of that for the left side.
  await page.addStyleTag({ content: '#panel, footer { display: none; } body { grid-template: 1fr / 1fr !important; }' });
  await dragLine(page, 1);
  // The samples of the CPU are others than the page's, 64 of each.
  for (const [key, name, most] of [['2', 'map', 0.004], ['1', 'original', 0.03], ['3', 'supersampled', 0.02]]) {
    await page.keyboard.press(key);
    if (name === 'supersampled')
      await page.waitForFunction(() => document.querySelector('#left').dataset.samples === '64', null, { timeout: 60000 });
    const found = await rmse(page, await picture(page), readFileSync(join(folder, `${name}.png`)));
    console.log(`${name}: RMSE ${found.rmse.toFixed(5)} of the CPU's picture over ${found.count} pixels`);
    expect(found.count > 5000 && found.rmse < most, `${name}: an RMSE below ${most}`);
  }
}

const part = page => page.locator('#divider').getAttribute('aria-valuenow').then(Number);
const height = page => page.locator('#height').textContent().then(text => parseInt(text, 10));

/** By the wheel, in the middle of the picture. */
async function zoom(page, pixels) {
  const box = await page.locator('#picture').boundingBox();
  await page.mouse.move(box.x + 60, box.y + 60);
  await page.mouse.wheel(0, pixels);
  await picture(page);
}

async function isMovedByPointerAndKeys(page) {
  const box = await page.locator('#picture').boundingBox();
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  const before = await picture(page);
  await dragLine(page, 0.25);
  expect(Math.abs((await part(page)) - 25) <= 1, `the line at 25 % after it was dragged there, found ${await part(page)}`);
  expect(!before.equals(await picture(page)), 'more of the right picture after the line moved');
  await page.locator('#divider').focus();
  await page.keyboard.press('ArrowRight');
  expect((await part(page)) === 27, 'the line to move by its arrow keys');
  await page.keyboard.press('.');
  expect((await part(page)) === 29, 'the line to move by a key');

  await page.locator('#picture').focus();
  const home = await picture(page);
  await page.keyboard.press('ArrowLeft');
  const turned = await picture(page);
  expect(!home.equals(turned), 'arrow keys to turn');
  const tall = await height(page);
  await page.keyboard.press('-');
  expect((await height(page)) < tall, 'minus to go farther');
  await page.mouse.move(middle.x + 60, middle.y);
  await page.mouse.wheel(0, -300);
  await page.waitForFunction(tall => parseInt(document.querySelector('#height').textContent, 10) > tall, tall);
  await page.mouse.down();
  await page.mouse.move(middle.x + 100, middle.y + 30, { steps: 2 });
  await page.mouse.up();
  await page.keyboard.press('h');
  expect(home.equals(await picture(page)), 'the first picture again by h');
  await page.keyboard.press('Shift+Digit2');
  expect((await page.locator('#right select').inputValue()) === 'map', 'shift and 2 to show the map on the right');
  await page.locator('#right select').selectOption('original');
  expect(home.equals(await picture(page)), 'the first picture again by the menu');
}

async function followsItsSliders(page) {
  const slide = (name, value) => page.locator('#panel label', { hasText: name }).locator('input').first().fill(value);
  const before = await picture(page);
  await slide('brightness', '700');
  const brighter = await picture(page);
  expect(!before.equals(brighter), 'a brighter light');
  expect(await page.locator('#left .stale').isHidden(), 'no word of another pattern');
  await slide('yellow', '#d01010');
  expect(!brighter.equals(await picture(page)), 'another colour');
  expect(await page.locator('#left .stale').isHidden(), 'a colour to be followed by the map');
  await slide('threshold', '600');
  await picture(page);
  expect(await page.locator('#left .stale').isVisible(), 'to hear that the map has the pattern of the bake');
  await page.screenshot({ path: join(folder, 'changed.png') });
  await page.locator('.reset').click();
  expect(before.equals(await picture(page)), 'the first picture again by a reset');
}

/** How much pictures of a few pixels differ as the scene turns: the map's against the shader's. */
async function doesNotShimmerFarAway(page) {
  await dragLine(page, 1);
  await zoom(page, 870);
  expect(Math.abs((await height(page)) - 20) < 10, `to be about 20 pixels high, found ${await height(page)}`);
  const flicker = {};
  for (const [key, name] of [['2', 'map'], ['1', 'original']]) {
    await page.keyboard.press(key);
    let last = await picture(page), sum = 0;
    for (let i = 0; i < 3; ++i) {
      await page.keyboard.press('ArrowRight');
      const next = await picture(page);
      sum += (await rmse(page, last, next)).rmse ** 2;
      last = next;
    }
    flicker[name] = Math.sqrt(sum / 3);
    await page.keyboard.press('h');
    await zoom(page, 870);
  }
  console.log(`${await height(page)} pixels high, 3 degrees a frame: change ${flicker.map.toFixed(4)} by the map, ${flicker.original.toFixed(4)} by the shader`);
  expect(flicker.map < 0.5 * flicker.original, 'the map to change less than half as much as the shader');
  await zoom(page, 2000);
  expect((await height(page)) <= 4, `to be a few pixels high, found ${await height(page)}`);
  await page.screenshot({ path: join(folder, 'tiny.png') });
  await page.keyboard.press('h');
}

async function looksRight(page) {
  await page.setViewportSize({ width: 800, height: 400 });
  for (const scheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme: scheme });
    await picture(page);
    await page.screenshot({ path: join(folder, `${scheme}.png`) });
  }
  await page.setViewportSize({ width: 704, height: 220 });
  await zoom(page, -2500);
  expect((await height(page)) > 300, `to be close up, found ${await height(page)} pixels`);
  await page.screenshot({ path: join(folder, 'close.png') });
  await page.keyboard.press('h');
  await page.setViewportSize({ width: 390, height: 320 });
  await picture(page);
  const needed = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(needed <= 390, `a page no wider than 390, found ${needed}`);
  await page.screenshot({ path: join(folder, 'narrow.png') });
}

async function isMovedByFingers() {
  const context = await open([...software, '--touch-events'], { viewport: { width: 320, height: 240 }, hasTouch: true });
  const page = await watched(context);
  const touch = await context.newCDPSession(page);
  const send = (type, ...points) => touch.send('Input.dispatchTouchEvent', {
    type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const before = await picture(page), tall = await height(page);
  await send('touchStart', [110, 120], [200, 120]);
  await send('touchMove', [80, 120], [230, 120]);
  await send('touchMove', [50, 120], [260, 120]);
  await send('touchEnd');
  await picture(page);
  expect((await height(page)) > 1.5 * tall, `two fingers to zoom, from ${tall} found ${await height(page)} pixels`);
  const near = await picture(page);
  await send('touchStart', [60, 110]);
  await send('touchMove', [110, 120]);
  await send('touchEnd');
  const turned = await picture(page);
  expect(!near.equals(turned) && !before.equals(turned), 'a finger to turn');
  const x = (await page.locator('#divider').boundingBox()).x + 16;
  await send('touchStart', [x, 100]);
  await send('touchMove', [x - 100, 100]);
  await send('touchEnd');
  expect((await part(page)) < 35, `a finger to move the line, found ${await part(page)} %`);
  await context.close();
}

async function saysWhatIsWrong(context) {
  let page = await watched(context, '?scene=nowhere');
  expect((await message(page)).includes('nowhere/scene.json: expected a scene, found status 404'),
    `the missing scene named, found: ${await message(page)}`);
  page = await watched(context, '?export=nowhere');
  expect((await message(page)).includes('nowhere/manifest.json'), `the missing manifest named, found: ${await message(page)}`);
  await page.close();
  const broken = async (pattern, change, part) => {
    await context.route(pattern, async route => {
      const response = await route.fetch();
      await route.fulfill({ response, body: change(await response.body()) });
    });
    const page = await watched(context);
    expect((await message(page)).includes(part), `"${part}", found: ${await message(page)}`);
    await page.close();
    await context.unroute(pattern);
  };
  await broken('**/weights.bin.gz', body => body.subarray(0, body.length / 2), 'weights.bin.gz: expected a whole file');
  await broken('**/0_ball/manifest.json', body => body.toString().replace('"levels": 9,\n    "wraps_u"', '"levels": 8,\n    "wraps_u"'),
    'weights.bin: expected');
  await broken('**/0_ball/manifest.json', body => body.toString().replace('"layers": 1', '"layers": "one"'),
    'weights.layers: expected a whole number from 1 to 8, found "one"');
  await broken('**/redmap.glsl', body => `${body}\nvoid nonsense(`, 'redmap.glsl: expected GLSL that compiles');
  const without = await open(['--disable-gpu', '--disable-3d-apis']);
  page = await watched(without);
  expect((await message(page)).includes('needs WebGL2'), `to hear of WebGL2, found: ${await message(page)}`);
  await page.screenshot({ path: join(folder, 'error.png') });
  await without.close();
}

const context = await open(software, { viewport: { width: 704, height: 220 } });
try {
  const page = await watched(context);
  expect((await message(page)) === '', `a picture, found: ${await message(page)}`);
  if (!isShort) {
    await isMovedByPointerAndKeys(page);
    await followsItsSliders(page);
    await looksRight(page);
    await page.setViewportSize({ width: 704, height: 200 });
    await doesNotShimmerFarAway(page);
  }
  await drawsTheCpusPicture(page);
  const outside = page.asked.filter(url => !url.startsWith(address) && !url.startsWith('data:'));
  expect(outside.length === 0, `nothing asked of a network, found ${outside}`);
  expect(page.complaints.length === 0, `no complaint of the browser, found ${page.complaints}`);
  await page.close();
  if (!isShort) {
    await isMovedByFingers();
    await saysWhatIsWrong(context);
  }
} finally {
  await context.close();
  rmSync(profile, { recursive: true, force: true });
}
process.exit(failures === 0 ? 0 : 1);
