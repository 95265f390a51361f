// Reads report.html as a reader would, in headless Chromium: report_check.mjs REPORT [SCREENSHOTS]
// Exit status 0 if it asks nothing of a network, complains of nothing, plays, and film, curve and keys agree.
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { inBrowser } from './browser.mjs';

const [report, pictures] = process.argv.slice(2);
await inBrowser({ width: 1280, height: 900 }, async (page, complaints) => {
  const picture = async name => { if (pictures) await page.screenshot({ path: `${pictures}/${name}.png`, fullPage: true }); };
  const wrong = [];
  const expect = (holds, what) => { if (!holds) wrong.push(what); };
  await page.emulateMedia({ colorScheme: 'light' });
  await page.goto(pathToFileURL(resolve(report)).href);
  await page.waitForFunction(() => document.querySelector('video').readyState >= 2, null, { timeout: 20000 });
  const run = await page.evaluate(() => JSON.parse(document.getElementById('run').textContent));
  const frame = () => page.evaluate(fps => Math.floor(document.querySelector('video').currentTime * fps + 1e-3), run.fps);
  const settled = () => page.waitForFunction(() => !document.querySelector('video').seeking);
  const readout = () => page.locator('#readout').textContent();
  const cursor = k => page.locator('.cursor').nth(k).locator('line').getAttribute('x1').then(Number);
  const frameAt = t => run.frames.findIndex(f => f >= t * (1 - 1e-12));
  await picture('wide-light');
  expect(!await page.locator('#film img').isVisible(), 'the poster stands beside the film');
  for (const overlay of await page.locator('.cursor').all()) {
    const boxes = await overlay.evaluate(svg => [svg, svg.parentElement.querySelector('.light svg')].map(e => e.getBoundingClientRect().toJSON()));
    expect(['x', 'y', 'width', 'height'].every(k => Math.abs(boxes[0][k] - boxes[1][k]) < 1), 'the cursor does not lie over its curve');
  }

  // Until the film plays, the poster stands in its place, and curves and readout show the moment of it.
  const film = await page.locator('video').boundingBox();
  const top = { x: film.x, y: film.y, width: film.width, height: film.height / 2 };  // without the controls
  const atFirst = await page.screenshot({ clip: top });
  await page.addStyleTag({ content: 'video.aside { display: none } #film img.aside { display: block }' });
  const aside = on => page.evaluate(on => document.querySelectorAll('#film > *').forEach(e => e.classList.toggle('aside', on)), on);
  await aside(true);
  const poster = await page.screenshot({ clip: top });
  await aside(false);
  const posterFrame = frameAt(run.poster), cursorAtFirst = await cursor(0), readoutAtFirst = await readout();
  expect(posterFrame > 0, `the poster shows frame ${posterFrame}`);

  // Mean difference of two pictures (levels): the browser scales a poster a little otherwise than a picture.
  const difference = (a, b) => page.evaluate(async pictures => {
    const pixels = await Promise.all(pictures.map(async png => {
      const image = new Image();
      image.src = 'data:image/png;base64,' + png;
      await image.decode();
      const pen = new OffscreenCanvas(image.width, image.height).getContext('2d');
      pen.drawImage(image, 0, 0);
      return pen.getImageData(0, 0, image.width, image.height).data;
    }));
    return pixels[0].reduce((sum, level, k) => sum + Math.abs(level - pixels[1][k]), 0) / pixels[0].length;
  }, [a, b].map(png => png.toString('base64')));

  // One frame further, and back, and to the end.
  await page.locator('body').click({ position: { x: 5, y: 5 } });
  await page.keyboard.press('Home'); await settled();
  expect(await frame() === 0, `Home goes to frame ${await frame()}`);
  expect(await cursor(0) < cursorAtFirst, 'the cursor does not start at the moment of the poster');
  expect(await readout() !== readoutAtFirst, 'the readout does not start at the moment of the poster');
  const fromPoster = await difference(atFirst, poster), fromStart = await difference(atFirst, await page.screenshot({ clip: top }));
  expect(fromPoster < 0.1 * fromStart, `before it plays, the film is ${fromPoster} levels from the poster, ${fromStart} from its first frame`);
  for (const [key, expected] of [['ArrowRight', 1], ['ArrowRight', 2], ['ArrowLeft', 1], ['Shift+ArrowRight', 1 + run.fps], ['End', run.frames.length - 1]]) {
    await page.keyboard.press(key); await settled();
    expect(await frame() === Math.min(expected, run.frames.length - 1), `${key} goes to frame ${await frame()}, not ${expected}`);
  }
  // The buttons of the events and the key frames.
  for (const button of await page.locator('button[data-time]').all()) {
    const time = Number(await button.getAttribute('data-time'));
    await button.click(); await settled();
    expect(await frame() === frameAt(time), `"${await button.textContent()}" goes to frame ${await frame()}, not ${frameAt(time)}`);
  }
  // A click on the curve over time: half way along the axis.
  for (const [k, place] of run.charts.entries()) {
    const overlay = page.locator('.cursor').nth(k);
    await overlay.scrollIntoViewIfNeeded();
    const box = await overlay.boundingBox();
    const view = await overlay.evaluate(svg => [svg.viewBox.baseVal.width, svg.viewBox.baseVal.height]);
    const clickAt = async (x, y) => {
      await page.mouse.click(box.x + x / view[0] * box.width, box.y + y / view[1] * box.height);
      await settled();
    };
    await page.keyboard.press('Home'); await settled();
    const before = await readout();
    if (place.of_time) {
      await clickAt(place.axes[0] + place.axes[2] / 2, place.axes[1] + place.axes[3] / 2);
      const time = (place.x[0] + place.x[1]) / 2;
      expect(Math.abs(await frame() - frameAt(time)) <= 1, `a click at ${time} s goes to frame ${await frame()}, not ${frameAt(time)}`);
      expect(Math.abs(await cursor(k) - (place.axes[0] + place.axes[2] / 2)) < 0.05 * place.axes[2], 'the cursor is not where the click was');
    } else {
      // A point of the curve: the click on it goes to its time.
      const h = run.history, row = Math.floor(h.time.findIndex(t => t >= place.until) / 2);
      const along = (range, v) => (v - range[0]) / (range[1] - range[0]);
      await clickAt(place.axes[0] + place.axes[2] * along(place.x, h.displacement[row]),
        place.axes[1] + place.axes[3] * (1 - along(place.y, h.load[row])));
      const off = Math.abs(run.frames[await frame()] - h.time[row]);
      expect(off < 0.05 * place.until, `a click on the curve at ${h.time[row]} s goes to ${run.frames[await frame()]} s`);
    }
    expect(await readout() !== before, 'the readout does not follow a click');
  }
  // The cursor follows the film.
  await page.keyboard.press('Home'); await settled();
  const start = await cursor(run.charts.length - 1);
  await page.locator('#play').click();
  await page.waitForFunction(fps => document.querySelector('video').currentTime * fps > 6.5, run.fps, { timeout: 90000 }).catch(() => {});
  await page.locator('#play').click();
  expect(await frame() > 5, 'the film does not play');
  expect(await cursor(run.charts.length - 1) > start, 'the cursor does not follow the film');

  // Themes, narrow screens, print.
  await page.locator('#theme').click();
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  expect(await background() === 'rgb(16, 18, 23)', `the dark theme is ${await background()}`);
  await picture('wide-dark');
  for (const width of [768, 360]) {
    await page.setViewportSize({ width, height: 800 });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(wide <= width, `at ${width} pixels the page is ${wide} wide`);
    const small = await page.evaluate(() => Math.min(...[...document.querySelectorAll('p, td, th, button, span, pre, figcaption, kbd')]
      .filter(e => e.offsetParent).map(e => parseFloat(getComputedStyle(e).fontSize))));
    expect(small >= 11, `text of ${small} pixels`);
    await picture(`narrow-${width}`);
  }
  await page.setViewportSize({ width: 900, height: 1200 });
  await page.emulateMedia({ media: 'print' });
  expect(!await page.locator('video').isVisible() && await page.locator('#film img').isVisible(), 'print shows no poster');
  expect(!await page.locator('#play').isVisible(), 'print shows buttons');
  expect(await background() === 'rgb(255, 255, 255)', 'print is not white');
  await picture('print');

  wrong.push(...complaints);
  return wrong.join('\n');
});
