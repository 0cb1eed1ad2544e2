import { outcomeText, problemText, type Parameter, type ParameterList, type Progress } from '../lib/parameters';

const POLL_MS = 400;

/** How this app asks the station over HTTP. */
export type Ask = (address: string, init?: RequestInit) => Promise<Response | undefined>;

/** One vehicle's parameters in this browser: nothing is asked for until `fetch` is called. */
export class VehicleParameters {
  list = $state.raw<ParameterList | undefined>();
  /** When the list came, by this browser's clock, ISO 8601. */
  fetched = $state('');
  /** Of the list on its way; nothing when none is. */
  progress = $state.raw<Progress | undefined>();
  /** The parameter that is being set. */
  setting = $state('');
  /** What came of the last request: good news, or why not. */
  outcome = $state('');
  problem = $state('');

  constructor(
    private readonly vehicle: string,
    private readonly ask: Ask,
  ) {}

  /** One thing at a time: a list that was begun before a change would bring the old value back. */
  get isBusy(): boolean {
    return this.progress !== undefined || this.setting !== '';
  }

  async fetch(): Promise<void> {
    if (this.isBusy) return;
    this.tell('', '');
    this.progress = { fetching: true };
    const timer = setInterval(() => void this.look(), POLL_MS);
    const list = await this.answer<ParameterList>(this.address(''));
    clearInterval(timer);
    this.progress = undefined;
    if (!list) return;
    this.list = list;
    this.fetched = new Date().toISOString();
    this.tell(`${list.parameters.length} parameters fetched.`, '');
  }

  /** Whether the vehicle holds the value now. */
  async set(name: string, value: number, operator: string): Promise<boolean> {
    if (this.isBusy) return false;
    this.tell('', '');
    this.setting = name;
    const set = await this.answer<Parameter & { before: number | null }>(this.address('/value', { name }), {
      method: 'PUT',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ value, operator }),
    });
    // A vehicle that stored something else is asked what.
    const now = set ?? (await this.quietly<Parameter>(this.address('/value', { name })));
    this.setting = '';
    if (now) this.replace(now);
    if (set) this.tell(outcomeText(set), '');
    return set !== undefined;
  }

  /** The file's text and name, of the list that is shown. */
  async file(): Promise<{ text: string; name: string } | undefined> {
    this.tell('', '');
    const response = await this.ask(this.address('/file', { cached: 'true' }));
    if (!response?.ok) return this.complain(response);
    const text = await response.text().catch(() => undefined);
    if (text === undefined) return this.complain(undefined);
    const name = /filename="([^"]+)"/.exec(response.headers.get('Content-Disposition') ?? '')?.[1];
    return { text, name: name ?? 'vehicle.params' };
  }

  private tell(outcome: string, problem: string): void {
    this.outcome = outcome;
    this.problem = problem;
  }

  private replace({ name, value, type }: Parameter): void {
    if (!this.list) return;
    const parameters = this.list.parameters.map((one) => (one.name === name ? { name, value, type } : one));
    this.list = { ...this.list, parameters };
  }

  private async look(): Promise<void> {
    const progress = await this.quietly<Progress>(this.address('/progress'));
    if (progress?.fetching && this.progress) this.progress = progress;
  }

  private address(what: string, more: Record<string, string> = {}): string {
    return `/api/v1/parameters${what}?${new URLSearchParams({ vehicle: this.vehicle, ...more }).toString()}`;
  }

  private async quietly<T>(address: string): Promise<T | undefined> {
    return body<T>(await this.ask(address));
  }

  private async answer<T>(address: string, init?: RequestInit): Promise<T | undefined> {
    const response = await this.ask(address, init);
    if (response && !response.ok) return this.complain(response);
    return (await body<T>(response)) ?? this.complain(undefined);
  }

  private async complain(response: Response | undefined): Promise<undefined> {
    const problem: unknown = await response?.json().catch(() => undefined);
    this.tell('', problemText(response?.status, problem));
  }
}

/** Nothing of a refusal, and of an answer that breaks off. */
async function body<T>(response: Response | undefined): Promise<T | undefined> {
  return response?.ok ? ((await response.json().catch(() => undefined)) as T | undefined) : undefined;
}
