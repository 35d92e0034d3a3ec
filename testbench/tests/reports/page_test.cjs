// Tests pages of results in headless Chromium:
// node page_test.cjs PAGE LARGE-PAGE FAILED-PAGE CRASHED-PAGE METHODS-PAGE VERIFY-PAGE [FOLDER]
// PAGE has 15 runs: rom_address_bits 5 to 9, of which 5 is refused, by diffuse_fraction_bits 4, 8,
// 16. LARGE-PAGE has 10,000. FAILED-PAGE has 2 runs that failed and 2 that passed, of a scene with
// a hostile name; those of CRASHED-PAGE all crashed. METHODS-PAGE is of `compare`, VERIFY-PAGE of
// `verify` for 2 scenes. Screenshots go to FOLDER, if it is given.
'use strict';
const assert = require('assert');
const fs = require('fs');
const path = require('path');
const {chromium} = require('playwright-core');

const [pageFile, largeFile, failedFile, crashedFile, methodsFile, verifyFile, folder] =
    process.argv.slice(2);
const address = (file) => 'file://' + path.resolve(file);

// Opens a page that may ask for nothing but itself and pictures beside it, and may report no error.
async function open(browser, file, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 900},
                                            permissions: ['clipboard-read', 'clipboard-write'],
                                            ...options});
  const page = await context.newPage();
  const faults = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) faults.push(message.text());
  });
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('request', (request) => {
    const url = request.url();
    const beside = path.dirname(url) === path.dirname(address(file)) && url.endsWith('.png');
    if (url !== address(file) && !beside && !/^(data|blob):/.test(url)) faults.push('asks for ' + url);
  });
  await page.goto(address(file));
  return {page, close: async () => {
    assert.deepStrictEqual(faults, []);
    await context.close();
  }};
}

async function download(page, button) {
  const [file] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
  return fs.readFileSync(await file.path(), 'utf8');
}

const count = (page, selector) => page.locator(selector).count();
// Waits until the table has so many rows, for pages are drawn after the event.
async function expectRows(page, expected) {
  const rows = () => count(page, 'tbody tr');
  for (let i = 0; i < 200 && await rows() !== expected; ++i) await page.waitForTimeout(50);
  assert.strictEqual(await rows(), expected);
}

// The middle of an axis, and its ends.
async function axis(page, name) {
  const overlay = page.locator(`g.axis[data-name="${name}"] .brush .overlay`);
  await overlay.scrollIntoViewIfNeeded();
  const box = await overlay.boundingBox();
  return {x: box.x + box.width / 2, top: box.y, bottom: box.y + box.height};
}

async function drag(page, x, from, to) {
  await page.mouse.move(x, from);
  await page.mouse.down();
  await page.mouse.move(x, (from + to) / 2);
  await page.mouse.move(x, to);
  await page.mouse.up();
  await page.waitForTimeout(100);
}

const rom = 'datapath.rom_address_bits';

const tests = {
  async 'draws every run that has measurements, and tells of the others'(page) {
    assert.strictEqual(await count(page, '#scatter .point'), 12);
    await expectRows(page, 15);
    assert.match(await page.textContent('#scatter-text'), /3 refused/);
    assert.match(await page.textContent('#summary'), /15 runs[^]*12 passed, 0 failed, 3 refused/);
    assert.ok(await count(page, '#scatter .front') > 0);
    assert.strictEqual(await page.title(), await page.textContent('h1'));
  },
  async 'the front is the one that no run beats'(page) {
    const text = await download(page, '#csv');
    const [head, ...lines] = text.trim().split('\n').map((line) => line.split(','));
    const of = (line, name) => Number(line[head.indexOf(name)]);
    const passed = lines.filter((line) => line[head.indexOf('outcome')] === 'passed');
    const measures = passed.map((line) => [of(line, 'frame_ns_per_pixel'), of(line, 'max_lsb')]);
    const front = measures.filter(([a, b]) => !measures.some(([c, d]) =>
        c <= a && d <= b && (c < a || d < b)));
    assert.strictEqual(await count(page, '#scatter .front'), front.length);
  },
  async 'other measures have another front'(page) {
    await page.selectOption('#x', 'rom_bits');
    await page.selectOption('#y', 'psnr_db');
    assert.ok(await count(page, '#scatter .front') > 0);
    assert.match(await page.textContent('#scatter'), /psnr_db, dB \(more is better\)/);
    assert.strictEqual(await count(page, 'g.axis[data-name="psnr_db"]'), 1);
    await page.selectOption('#x', 'triangles_read');
    assert.strictEqual(await count(page, '#scatter .front'), 0);
    assert.match(await page.textContent('#scatter-text'), /No front/);
    await page.selectOption('#x', 'frame_ns_per_pixel');
    await page.selectOption('#y', 'max_lsb');
    await page.check('#log-x');
    await page.check('#log-y');
    assert.strictEqual(await count(page, '#scatter .point'), 12);
    await page.uncheck('#log-x');
    await page.uncheck('#log-y');
  },
  async 'a brush on an axis filters points, table and CSV'(page) {
    const choose8And9 = async () => {  // of 5 to 9
      const {x, top, bottom} = await axis(page, rom);
      await drag(page, x, top + 1, (top + bottom) / 2 - 4);
      await expectRows(page, 6);
    };
    await choose8And9();
    assert.strictEqual(await count(page, '#scatter .point'), 6);
    assert.match(await page.textContent('#count'), /6 of 15 runs/);
    const lines = (await download(page, '#csv')).trim().split('\n');
    assert.strictEqual(lines.length, 7);
    const at = lines[0].split(',').indexOf(rom);
    assert.ok(lines.slice(1).every((line) => ['8', '9'].includes(line.split(',')[at])));
    const {x, top, bottom} = await axis(page, rom);  // it moves when the page scrolls
    await page.mouse.dblclick(x, (top + bottom) / 2);
    await expectRows(page, 15);
    await choose8And9();
    await page.keyboard.press('Escape');
    await expectRows(page, 15);
  },
  async 'no line runs behind the numbers of the first and the last axis'(page) {
    const sides = await page.evaluate(() => {
      const axes = [...document.querySelectorAll('#parallel g.axis')];
      return [axes[0], axes[axes.length - 1]].map((element) => {
        const x = element.querySelector('.domain').getBoundingClientRect().x;
        return [...element.querySelectorAll('.tick text')].map((text) =>
            Math.sign(text.getBoundingClientRect().x - x));
      });
    });
    assert.ok(sides[0].length > 0 && sides[0].every((side) => side < 0), `${sides[0]}`);
    assert.ok(sides[1].length > 0 && sides[1].every((side) => side > 0), `${sides[1]}`);
  },
  async 'a filter is made and cleared by keyboard'(page) {
    await page.focus(`g.axis[data-name="${rom}"]`);
    for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowDown');
    await expectRows(page, 9);  // without 8 and 9
    for (let i = 0; i < 6; ++i) await page.keyboard.press('Shift+ArrowUp');
    await expectRows(page, 3);
    await page.keyboard.press('Delete');
    await expectRows(page, 15);
  },
  async 'the table is sorted by its heads, by keyboard too'(page) {
    const column = async (name) => {
      const heads = await page.locator('thead th').allTextContents();
      const at = heads.findIndex((head) => head.startsWith(name));
      const cells = await page.locator(`tbody td:nth-child(${at + 1})`).allTextContents();
      return cells.filter((cell) => cell !== '–').map(Number);
    };
    await page.focus('thead button[data-name="max_lsb"]');
    await page.keyboard.press('Enter');
    const up = await column('max_lsb');
    assert.strictEqual(up.length, 12);
    assert.deepStrictEqual(up, up.slice().sort((a, b) => a - b));
    assert.strictEqual(await page.getAttribute('th:has([data-name="max_lsb"])', 'aria-sort'),
                       'ascending');
    await page.keyboard.press('Enter');
    assert.deepStrictEqual(await column('max_lsb'), up.reverse());
    assert.strictEqual(await page.getAttribute('th:has([data-name="max_lsb"])', 'aria-sort'),
                       'descending');
    assert.strictEqual(await count(page, 'th[aria-sort="descending"]'), 1);
    // The runs without a value come last both ways.
    assert.match(await page.locator('tbody tr').last().textContent(), /refused/);
  },
  async 'a point opens its run, with pictures, command and hardware'(page) {
    await page.focus('#scatter .point[tabindex="0"]');
    await page.keyboard.press('End');
    const shown = await page.textContent('#shown');
    await page.keyboard.press('Enter');
    const dialog = page.locator('dialog[open]');
    const bits = /rom_address_bits(\d+) bits/.exec(shown)[1];
    const command = await dialog.locator('#command').textContent();
    assert.ok(command.startsWith("phongpipe verify sphere --set scene.image.width=96 "), command);
    assert.ok(command.includes("--set 'scene.object.0.segments=[12,8]'"), command);
    assert.ok(command.includes(`--set ${rom}=${bits}`), command);
    await dialog.locator('#copy').click();
    assert.strictEqual(await page.evaluate(() => navigator.clipboard.readText()), command);
    const toml = await download(page, '#toml');
    assert.match(toml, new RegExp(`\\[datapath\\]\n[^[]*rom_address_bits = ${bits}\n`));
    if (folder) fs.writeFileSync(path.join(folder, 'run.toml'), toml);
    if (folder) fs.writeFileSync(path.join(folder, 'run.command'), command);
    await page.keyboard.press('Escape');
    assert.strictEqual(await dialog.count(), 0);

    await page.locator('#scatter .front').first().click();
    const images = page.locator('dialog[open] img');
    assert.strictEqual(await images.count(), 2);
    for (const image of await images.all()) {
      assert.ok(await image.isVisible());
      assert.strictEqual(await image.evaluate((element) => element.naturalWidth), 96);
    }
    await page.click('dialog form button');
  },
};

async function main() {
  const browser = await chromium.launch({executablePath: '/usr/bin/chromium',
                                         args: ['--no-sandbox']});
  let failed = 0;
  const attempt = async (name, test) => {
    try {
      await test();
      console.log('ok      ' + name);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n${error.stack}`);
    }
  };
  for (const [name, test] of Object.entries(tests)) {
    await attempt(name, async () => {
      const {page, close} = await open(browser, pageFile);
      await test(page);
      await close();
    });
  }
  await attempt('10,000 runs fit into 5 MB, load, and are filtered', async () => {
    assert.ok(fs.statSync(largeFile).size <= 5000000, `${fs.statSync(largeFile).size} bytes`);
    const before = Date.now();
    const {page, close} = await open(browser, largeFile);
    assert.strictEqual(await count(page, '#scatter .point'), 10000);
    await expectRows(page, 200);
    console.log(`        drawn after ${Date.now() - before} ms`);
    await page.click('#more');
    await expectRows(page, 400);
    const {x, top, bottom} = await axis(page, rom);
    await drag(page, x, top + 1, (top + bottom) / 2);
    const left = await count(page, '#scatter .point');
    assert.ok(left > 0 && left < 10000, `${left} points`);
    if (folder) await page.screenshot({path: path.join(folder, 'large.png'), fullPage: true});
    await close();
  });
  const screenshot = (page, name) => folder &&
      page.screenshot({path: path.join(folder, name + '.png'), fullPage: true});
  await attempt('failed runs are drawn apart, and hostile names do nothing', async () => {
    const {page, close} = await open(browser, failedFile);
    assert.strictEqual(await count(page, '#scatter .failed'), 2);
    assert.strictEqual(await count(page, '#scatter .point'), 4);
    assert.match(await page.textContent('#legend'), /not passed/);
    // So are their lines: each colour of the points is one of the lines', too.
    const missing = await page.evaluate(() => {
      const canvas = document.querySelector('#parallel canvas');
      const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const has = (name) => {
        const [r, g, b] = getComputedStyle(document.documentElement)
            .getPropertyValue('--' + name).match(/[0-9a-f]{2}/g).map((digits) => parseInt(digits, 16));
        for (let i = 0; i < data.length; i += 4) {
          const apart = Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b);
          if (data[i + 3] > 100 && apart < 12) return true;
        }
        return false;
      };
      return ['passed', 'failed'].filter((name) => !has(name));
    });
    assert.deepStrictEqual(missing, []);
    assert.strictEqual(await count(page, 'b'), 0);
    assert.match(await page.textContent('#summary'), /<\/script><b>x/);
    await page.locator('tbody button').first().click();
    assert.match(await page.textContent('#command'), /<\/script><b>x/);
    await close();
  });
  await attempt('runs without any result are in the table', async () => {
    const {page, close} = await open(browser, crashedFile);
    assert.match(await page.textContent('#summary'), /0 passed, 0 failed, 0 refused, 15 crashed/);
    assert.ok(!await page.isVisible('#scatter'));
    await expectRows(page, 15);
    await page.locator('tbody button').first().click();
    assert.match(await page.textContent('#command'), /^phongpipe verify sphere/);
    await close();
  });
  await attempt('a page of methods', async () => {
    const {page, close} = await open(browser, methodsFile);
    assert.match(await page.textContent('#summary'), /Least error for their time: /);
    assert.match(await page.textContent('#scatter'), /gouraud/);
    await page.locator('tbody tr', {hasText: 'gouraud'}).locator('button').click();
    assert.strictEqual(await count(page, 'dialog[open] img'), 2);
    assert.match(await page.textContent('#command'), /^phongpipe render sphere --set .* --method gouraud/);
    assert.ok(!await page.isVisible('#toml'));
    await page.click('dialog form button');
    await screenshot(page, 'methods');
    await close();
  });
  await attempt('a page of verified scenes', async () => {
    const {page, close} = await open(browser, verifyFile);
    await expectRows(page, 2);
    assert.strictEqual(await count(page, '#scatter .front'), 0);
    await page.locator('tbody button').first().click();
    const images = page.locator('dialog[open] img');
    assert.strictEqual(await images.count(), 3);
    for (const image of await images.all()) {
      assert.strictEqual(await image.evaluate((element) => element.decode().then(() => element.naturalWidth)), 96);
    }
    await page.click('dialog form button');
    await screenshot(page, 'verify');
    await close();
  });
  await attempt('prints on paper without controls', async () => {
    const {page, close} = await open(browser, pageFile, {colorScheme: 'dark'});
    await page.emulateMedia({media: 'print'});
    assert.ok(!await page.isVisible('#csv'));
    assert.ok(await page.isVisible('tbody tr >> nth=0'));
    await screenshot(page, 'print');
    const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.strictEqual(back, 'rgb(255, 255, 255)');
    assert.ok((await page.pdf()).length > 1000);
    await close();
  });
  await attempt('without JavaScript it says so, below its summary', async () => {
    const {page, close} = await open(browser, pageFile, {javaScriptEnabled: false});
    assert.match(await page.locator('body').innerText(), /15 runs[^]*need JavaScript/);
    await close();
  });
  for (const colorScheme of ['light', 'dark']) {
    for (const width of [1280, 400]) {
      await attempt(`nothing sticks out, ${colorScheme}, ${width} pixels wide`, async () => {
        const {page, close} = await open(browser, pageFile,
                                         {colorScheme, viewport: {width, height: 900}});
        const widest = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(widest <= width, `${widest} pixels`);
        const shot = (name) => folder && page.screenshot(
            {path: path.join(folder, `${name}-${colorScheme}-${width}.png`), fullPage: true});
        await page.locator('#scatter .front').first().hover();
        await shot('page');
        await page.locator('#scatter .front').first().click();
        assert.ok((await page.locator('dialog[open]').boundingBox()).width <= width);
        if (folder) await page.screenshot(
            {path: path.join(folder, `run-${colorScheme}-${width}.png`)});
        await close();
      });
    }
  }
  await browser.close();
  console.log(failed === 0 ? 'PASSED' : `FAILED: ${failed}`);
  process.exit(failed === 0 ? 0 : 1);
}

main();
