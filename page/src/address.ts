// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What is chosen, in the address of the page.

/** What the address says after the `#`: `clash=3`, `t=1.5` or both with a `&` between. */
export function inAddress(key: string): string {
  const steps = location.hash.slice(1).split('&');
  const step = steps.find((one) => one.startsWith(`${key}=`));
  try {
    return decodeURIComponent(step?.slice(key.length + 1) ?? '');
  } catch {
    return '';
  }
}

/** Browsers refuse to be told too often, as when a key is held down. */
export function tellAddress(hash: string): void {
  try {
    history.replaceState(null, '', location.href.split('#')[0] + hash);
  } catch {
    // The address then names an earlier clash, until the next is chosen.
  }
}
