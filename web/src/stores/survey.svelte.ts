import { bodyOf } from '../lib/files/answers';
import { conditionOf, inNeed, surveyOf, type SurveyDrone } from '../lib/reports/survey';
import type { Session } from './session.svelte';

/** One command as the drone reads it (docs/reference/operation-states.md). */
export type SurveyCommand = Readonly<{ Type: string } & Record<string, string | number>>;

/** Survey drones, and what they are told. */
export class SurveyStore {
  drones = $state.raw<readonly SurveyDrone[]>([]);
  /** Why the last command to a drone was not handed on, by its name. */
  refusals = $state.raw<Readonly<Record<string, string>>>({});

  constructor(private readonly session: Session) {
    session.follow('survey', ({ content }) => this.take(surveyOf(content)));
  }

  /** How many need somebody. */
  get inNeed(): number {
    return inNeed(this.drones);
  }

  async command(drone: string, command: SurveyCommand): Promise<void> {
    const answer = await this.session.ask(`/api/v1/survey/${encodeURIComponent(drone)}/commands`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(command),
    });
    const { failure } = await bodyOf(answer);
    this.refusals = { ...this.refusals, [drone]: failure };
  }

  private take(drones: SurveyDrone[]): void {
    const before = new Map(this.drones.map((drone) => [drone.name, conditionOf(drone)]));
    for (const drone of drones) {
      const { level, text } = conditionOf(drone);
      const isBad = level === 'critical' || level === 'warning';
      if (isBad && before.has(drone.name) && before.get(drone.name)?.text !== text) this.session.announce(`${drone.name}: ${text}.`);
    }
    this.drones = drones;
  }
}
