// Plays a film in headless Chromium and seeks in it: film_check.mjs MOVIE WIDTH HEIGHT SECONDS
// Exit status 0 if it plays, has that size and length, and every seek arrives.
import { writeFile } from 'node:fs/promises';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { inBrowser } from './browser.mjs';

const [movie, ...numbers] = process.argv.slice(2);
const [width, height, seconds] = numbers.map(Number);
const folder = await mkdtemp(join(tmpdir(), 'hibi-film-'));
process.on('exit', () => rm(folder, { recursive: true, force: true }));
const file = join(folder, 'film.html');
await writeFile(file, `<!doctype html><meta charset="utf-8"><video muted preload="auto" src="${pathToFileURL(resolve(movie))}"></video>`);

await inBrowser({ width: 1280, height: 720 }, async page => {
  await page.goto(pathToFileURL(file).href);
  const log = await page.evaluate(async () => {
    const v = document.querySelector('video'), log = { seeks: [] };
    const within = (promise, what) => Promise.race([promise,
      new Promise((_, no) => setTimeout(() => no(new Error(what + (v.error ? ': ' + v.error.message : ''))), 10000))]);
    const until = name => within(new Promise(ok => v.addEventListener(name, ok, { once: true })), name + ' never came');
    if (v.readyState < 2) await until('loadeddata');
    Object.assign(log, { width: v.videoWidth, height: v.videoHeight, duration: v.duration });
    await v.play();
    await new Promise(r => setTimeout(r, 1000));
    v.pause();
    log.played = v.currentTime;
    for (const share of [0.9, 0.1, 0.5, 0.99]) {
      const shown = within(new Promise(ok => v.requestVideoFrameCallback((now, frame) => ok(frame.mediaTime))), 'no frame at ' + share);
      v.currentTime = share * v.duration;
      log.seeks.push(Math.abs(await shown - v.currentTime));  // of the picture itself, not of the clock
    }
    return log;
  });
  console.log(log);
  if (log.width !== width || log.height !== height || Math.abs(log.duration - seconds) > 0.05)
    return `expected ${width} x ${height} and ${seconds} s`;
  if (!(log.played > 0.3 && log.played <= seconds)) return 'it does not play';
  if (Math.max(...log.seeks) > 0.05) return 'a seek ended elsewhere';
});
