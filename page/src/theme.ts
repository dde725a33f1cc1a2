// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Light or dark: as the system has it, until the button is used.
import { byId } from './dom';

const system = matchMedia('(prefers-color-scheme: dark)');

let chosen: 'light' | 'dark' | null = null;

export const isDark = (): boolean => (chosen ?? (system.matches ? 'dark' : 'light')) === 'dark';

export function listenToTheme(onChange: () => void): () => void {
  const button = byId('theme-button');
  const update = () => {
    document.documentElement.dataset.theme = isDark() ? 'dark' : 'light';
    button.textContent = isDark() ? 'Light' : 'Dark';
    button.setAttribute('aria-label', isDark() ? 'Light colours' : 'Dark colours');
    onChange();
  };
  const toggle = () => {
    chosen = isDark() ? 'light' : 'dark';
    update();
  };
  button.addEventListener('click', toggle);
  system.addEventListener('change', update);
  update();
  return toggle;
}
