import { describe, expect, it } from 'vitest';
import { VehicleParameters } from './vehicle_parameters.svelte';

const LIST = {
  vehicle: '1',
  confirmed: 'vehicle',
  taken: '2026-05-01T12:00:00Z',
  parameters: [{ name: 'RTL_ALT', value: 1500, type: 'int32' }],
};

/** A station that answers each request when it is told to. */
function slowStation(): { asked: string[]; answer: (response: Response | undefined) => Promise<void>; parameters: VehicleParameters } {
  const asked: string[] = [];
  const waiting: ((response: Response | undefined) => void)[] = [];
  const parameters = new VehicleParameters('1', (address, init) => {
    if (address.includes('/progress')) return Promise.resolve(undefined);
    asked.push(`${init?.method ?? 'GET'} ${address.split('?')[0]}`);
    return new Promise((resolve) => waiting.push(resolve));
  });
  const answer = async (response: Response | undefined): Promise<void> => {
    waiting.shift()?.(response);
    await new Promise((resolve) => setImmediate(resolve));
  };
  return { asked, answer, parameters };
}

describe('VehicleParameters', () => {
  it('fetches once however often it is asked meanwhile', async () => {
    const { asked, answer, parameters } = slowStation();
    void parameters.fetch();
    void parameters.fetch();
    expect(asked).toEqual(['GET /api/v1/parameters']);
    await answer(Response.json(LIST));
    expect(parameters.list?.parameters).toHaveLength(1);
    expect(parameters.fetched).not.toBe('');
    expect(parameters.isBusy).toBe(false);
  });

  it('changes nothing while a list is on its way, which would bring the old value back', async () => {
    const { asked, answer, parameters } = slowStation();
    void parameters.fetch();
    expect(await parameters.set('RTL_ALT', 2000, 'anna')).toBe(false);
    expect(asked).toHaveLength(1);
    await answer(Response.json(LIST));

    void parameters.set('RTL_ALT', 2000, 'anna');
    void parameters.fetch();
    expect(asked.slice(1)).toEqual(['PUT /api/v1/parameters/value']);
    await answer(Response.json({ name: 'RTL_ALT', value: 2000, type: 'int32', before: 1500 }));
    expect(parameters.list?.parameters[0]?.value).toBe(2000);
    expect(parameters.outcome).toBe('RTL_ALT is 2000 now, was 1500.');
  });

  it('ends, and says so, when an answer breaks off', async () => {
    const { answer, parameters } = slowStation();
    void parameters.fetch();
    await answer(new Response('{"vehicle": "1", "param'));
    expect(parameters.progress).toBeUndefined();
    expect(parameters.problem).toBe('The station did not answer.');

    const file = parameters.file();
    const broken = new ReadableStream({ start: (stream) => stream.error(new Error('closed')) });
    await answer(new Response(broken));
    expect(await file).toBeUndefined();
    expect(parameters.problem).toBe('The station did not answer.');
  });

  it('keeps the list when it cannot be fetched anew, and shows what is stored after a refusal', async () => {
    const { answer, parameters } = slowStation();
    void parameters.fetch();
    await answer(Response.json(LIST));
    void parameters.fetch();
    await answer(undefined);
    expect(parameters.list?.parameters).toHaveLength(1);
    expect(parameters.problem).toBe('The station did not answer.');

    void parameters.set('RTL_ALT', 9000, 'anna');
    await answer(Response.json({ detail: 'vehicle 1 stored RTL_ALT = 8000, not 9000' }, { status: 409 }));
    await answer(Response.json({ name: 'RTL_ALT', value: 8000, type: 'int32' }));
    expect(parameters.list?.parameters[0]?.value).toBe(8000);
    expect(parameters.problem).toBe('vehicle 1 stored RTL_ALT = 8000, not 9000.');
  });
});
