// Looks at difference.html as a reader would, in headless Chromium: difference_check.mjs PAGE [SCREENSHOTS]
// Exit status 0 if it asks nothing of a network, complains of nothing, and slider, flicker, heat map and tiles work.
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { inBrowser } from './browser.mjs';

const [file, pictures] = process.argv.slice(2);
await inBrowser({ width: 1100, height: 900 }, async (page, complaints) => {
  const picture = async name => { if (pictures) await page.screenshot({ path: `${pictures}/${name}.png`, fullPage: true }); };
  const wrong = [];
  const expect = (holds, what) => { if (!holds) wrong.push(what); };
  await page.emulateMedia({ colorScheme: 'light' });
  await page.goto(pathToFileURL(resolve(file)).href);
  const view = page.locator('#view');
  // The share of the width at which the actual picture begins.
  const edge = () => view.evaluate(v => {
    const inset = getComputedStyle(v.querySelector('.actual')).clipPath.match(/inset\(.* ([\d.]+)%\)/);
    return inset ? Number(inset[1]) : null;
  });
  expect(await edge() === 50, `the slider begins at ${await edge()} %`);
  await picture('slider');
  // By keyboard, and by a drag on the picture.
  await page.locator('#split').focus();
  await page.keyboard.press('Home');
  expect(await edge() === 0, `Home moves the slider to ${await edge()} %`);
  await page.keyboard.press('End');
  expect(await edge() === 100, `End moves the slider to ${await edge()} %`);
  await view.scrollIntoViewIfNeeded();
  const box = await view.boundingBox();
  await page.mouse.move(box.x + box.width * 0.9, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.25, box.y + box.height / 2, { steps: 4 });
  await page.mouse.up();
  expect(Math.abs(await edge() - 25) < 1, `a drag to a quarter moves the slider to ${await edge()} %`);
  // What is seen on either side of the edge is the one picture and the other.
  const shown = await page.evaluate(() => ['expected', 'actual'].map(n => {
    const v = document.getElementById('view').getBoundingClientRect();
    const r = document.querySelector('#view .' + n).getBoundingClientRect();
    return Math.abs(r.x - v.x) + Math.abs(r.width - v.width) + Math.abs(r.height - v.height);
  }));
  expect(shown.every(off => off < 1), 'the pictures do not lie on each other');

  const visible = name => page.locator(`#view .${name}`).isVisible();
  await page.locator('[data-mode-of=heat]').click();
  expect(await visible('heat') && !await visible('actual'), 'the heat map does not show');
  await picture('heat');
  await page.locator('[data-mode-of=flicker]').click();
  const seen = new Set();
  for (let k = 0; k < 16; ++k) { seen.add(await visible('actual')); await page.waitForTimeout(125); }
  expect(seen.size === 2, 'it does not flicker');
  await page.locator('[data-mode-of=slider]').click();
  expect(await visible('actual') && !await visible('heat'), 'the slider does not come back');

  // The worst tile: each canvas holds the pixels of its picture, enlarged.
  for (const canvas of await page.locator('.tiles canvas').all()) {
    const off = await canvas.evaluate(c => {
      const [x, y, w, h] = c.dataset.tile.split(' ').map(Number);
      const small = document.createElement('canvas');
      const image = document.querySelector('#view .' + c.dataset.of);
      small.width = image.naturalWidth; small.height = image.naturalHeight;
      small.getContext('2d').drawImage(image, 0, 0);
      const a = small.getContext('2d').getImageData(x + w - 1, y + h - 1, 1, 1).data;
      const b = c.getContext('2d').getImageData(c.width - 3, c.height - 3, 1, 1).data;
      return Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2]);
    });
    expect(off === 0, 'a tile does not show its pixels');
  }
  expect(await page.locator('tr.wrong').count() > 0, 'no number is marked as beyond its limit');

  await page.locator('#theme').click();
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  expect(await background() === 'rgb(16, 18, 23)', `the dark theme is ${await background()}`);
  await picture('dark');
  for (const width of [768, 360]) {
    await page.setViewportSize({ width, height: 800 });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(wide <= width, `at ${width} pixels the page is ${wide} wide`);
  }
  await picture('narrow');
  wrong.push(...complaints);
  return wrong.join('\n');
});
