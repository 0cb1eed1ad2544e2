import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { DARK, LIGHT } from './colours';

it('are those of the page', () => {
  const css = readFileSync(new URL('../app.css', import.meta.url), 'utf8');
  const [light, dark] = css.split(":root[data-theme='dark']");
  for (const [colours, part] of [
    [LIGHT, light],
    [DARK, dark],
  ] as const) {
    // prettier-ignore
    const { ground, panel, text, accent, levels } = colours;
    for (const [name, colour] of Object.entries({ ground, panel, text, accent, ...levels }))
      expect(part, name).toContain(`--${name}: ${colour};`);
  }
});
