// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Colours of the 3D view. Those of the two shown parts are told apart by every kind of colour vision.
import { kVerdicts, type Verdict } from './data';

export type Rgb = [number, number, number];

/** Björn Ottosson's OKLCH to sRGB, 0 to 1. */
function oklch(lightness: number, chroma: number, hue: number): Rgb {
  const [a, b] = [chroma * Math.cos(hue), chroma * Math.sin(hue)];
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return linear.map((c) => {
    const x = Math.min(1, Math.max(0, c));
    return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
  }) as Rgb;
}

/** Calm colours, as different as their number allows: hues step by the golden angle. */
export function calmColour(index: number): Rgb {
  return oklch(0.75 + 0.045 * ((index * 2) % 3), 0.045 + 0.02 * (index % 2), 4.1 + index * 2.39996);
}

function hexColour(hex: string): Rgb {
  const n = parseInt(hex.trim().slice(1), 16);
  return [(n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255];
}

const style = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name);
export const themeColour = (name: string): Rgb => hexColour(style(name));

export const worst = (x: Verdict, y: Verdict): Verdict => (kVerdicts.indexOf(x) <= kVerdicts.indexOf(y) ? x : y);
