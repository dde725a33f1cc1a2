// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// node picture.mjs REPORT.html PICTURE.png [HASH]: a picture of a report, such as the one in the README. HASH says which
// clash is shown ("#clash=3"), as in the page's own address.
import { readFileSync } from 'node:fs';
import { startBrowser } from './tests/browser.mjs';

const [report, picture, hash = ''] = process.argv.slice(2);
if (!picture) {
  console.error('usage: node picture.mjs REPORT.html PICTURE.png [HASH]');
  process.exit(2);
}
const browser = await startBrowser();
try {
  const { page, close } = await browser.open(readFileSync(report, 'utf8'), { width: 1440, height: 860, hash });
  await page.waitForTimeout(1500);
  await page.screenshot({ path: picture });
  await close();
} finally {
  await browser.stop();
}
