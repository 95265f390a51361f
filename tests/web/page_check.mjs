// Reads a page in headless Chromium, wide and narrow, light and dark: page_check.mjs PAGE [SCREENSHOTS]
// Exit status 0 if it asks nothing of a network, complains of nothing, changes its theme, and fits every screen.
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { inBrowser } from './browser.mjs';

const [file, pictures] = process.argv.slice(2);
await inBrowser({ width: 1280, height: 900 }, async (page, complaints) => {
  const wrong = [];
  await page.emulateMedia({ colorScheme: 'light' });
  await page.goto(pathToFileURL(resolve(file)).href);
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  for (const theme of ['light', 'dark']) {
    for (const width of [1280, 390]) {
      await page.setViewportSize({ width, height: 900 });
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      if (wide > width) wrong.push(`at ${width} pixels the page is ${wide} wide`);
      if (pictures) await page.screenshot({ path: `${pictures}/${theme}-${width}.png`, fullPage: true });
    }
    const before = await background();
    await page.locator('#theme').click();
    if (await background() === before) wrong.push('the theme does not change');
  }
  wrong.push(...complaints);
  return wrong.join('\n');
});
