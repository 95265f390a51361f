// What the browser checks share: a page in headless Chromium, opened from disk, with what it complains of and
// what it asks a network for.
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

const flags = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-dev-shm-usage',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/// Calls check(page, complaints) with a page of the given size; complaints gathers console errors, uncaught
/// exceptions and every request that is not for a file or for data. Ends the program: status 0 where check
/// returns nothing, else 1 and what it returned on standard error.
export async function inBrowser(size, check) {
  const profile = await mkdtemp(join(tmpdir(), 'hibi-browser-'));
  let complaint;
  try {
    const context = await chromium.launchPersistentContext(profile,
      { executablePath: '/usr/bin/chromium', headless: true, args: flags, viewport: size });
    const page = context.pages()[0] ?? await context.newPage();
    const complaints = [];
    page.on('console', m => { if (['error', 'warning'].includes(m.type())) complaints.push(`console: ${m.text()}`); });
    page.on('pageerror', e => complaints.push(`exception: ${e.message}`));
    page.on('request', r => { if (!/^(file|data|blob|about):/.test(r.url())) complaints.push(`request: ${r.url().slice(0, 100)}`); });
    try {
      complaint = await check(page, complaints);
    } finally {
      await context.close();
    }
  } catch (error) {
    complaint = String(error.message ?? error);
  } finally {
    await rm(profile, { recursive: true, force: true });
  }
  if (complaint) console.error(complaint);
  process.exit(complaint ? 1 : 0);
}
