import type { Command } from './protocol';

/**
 * What the station asks of a command before anything is sent, by the names under which an operator can allow it.
 * docs/reference/plausibility.md has limits and cases.
 */
export const RULES: ReadonlyMap<string, string> = new Map([
  ['home_moved', 'home would be moved far from where the vehicle stands'],
  ['too_far', 'a place is far away'],
  ['zero_coordinates', 'a place is at latitude and longitude 0'],
  ['outside_fence', 'a place, or the way there, is outside a fence'],
  ['battery', 'it takes longer than the battery lasts'],
  ['home_height', 'home is far above or below the ground on which the vehicle stands'],
  ['below_ground', 'a place is at or below the ground'],
  ['take_off_height', 'the take-off hardly leaves the ground'],
  ['ceiling', 'a place is high above home'],
  ['no_take_off', 'the vehicle stands on the ground, and its mission has no take-off'],
  ['empty_mission', 'there is no mission to fly'],
  ['shared_pad', 'another vehicle stands or lands there'],
]);

/** A rule in the way of a command, and the vehicles that it was refused for. */
export interface Objection {
  rule: string;
  vehicles: string[];
}

/** The rules in the way of an operator's own command, as long as nothing else was asked of those vehicles. */
export function objectionsTo(command: Command, commands: readonly Command[], me: string): Objection[] {
  if (command.by !== me) return [];
  const later = new Set(
    commands.filter(({ number }) => number > command.number).flatMap(({ vehicles }) => vehicles.map((one) => one.vehicle)),
  );
  const refused = new Map<string, string[]>();
  for (const { vehicle, state, rule } of command.vehicles) {
    if (state === 'refused' && !later.has(vehicle) && rule !== undefined && RULES.has(rule))
      refused.set(rule, [...(refused.get(rule) ?? []), vehicle]);
  }
  return [...refused].map(([rule, vehicles]) => ({ rule, vehicles }));
}
