// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// node notebook-picture.mjs NOTEBOOK.html PICTURE.png WORD...: a picture of those cells of a notebook that have one of the words, with the
// second clash chosen in the report that one of them shows; such as the one in the README.
import { readFileSync } from 'node:fs';
import { startBrowser } from './tests/browser.mjs';

const [notebook, picture, ...words] = process.argv.slice(2);
if (!words.length) {
  console.error('usage: node notebook-picture.mjs NOTEBOOK.html PICTURE.png WORD...');
  process.exit(2);
}
const browser = await startBrowser();
try {
  const { page, close } = await browser.open(readFileSync(notebook, 'utf8'), { width: 1200, height: 1500 });
  await page.evaluate((kept) => {
    for (const cell of document.querySelectorAll('.jp-Cell'))
      if (!kept.some((word) => cell.querySelector('.jp-InputArea')?.textContent.includes(word))) cell.remove();
  }, words);
  await page.frameLocator('iframe').getByText('penetrates').nth(1).click();
  await page.waitForTimeout(4000);
  const bottom = await page.evaluate(() => document.querySelector('iframe').getBoundingClientRect().bottom);
  await page.screenshot({ path: picture, clip: { x: 0, y: 0, width: 1200, height: bottom + 24 } });
  await close({ ignoring: /Blocked autofocusing/ });
} finally {
  await browser.stop();
}
