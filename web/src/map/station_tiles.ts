type Ask = (address: string) => Promise<Response | undefined>;

export const STATION_PROTOCOL = 'station';

/**
 * Tiles that the station serves, whose addresses change while the map keeps its sources, and which ask for the token that this page
 * has. A map asks for `station://NAME/z/x/y`; what is fetched is what stands for the name then.
 */
class StationTiles {
  private readonly sources = new Map<string, { template: string; ask: Ask }>();

  set(name: string, template: string, ask: Ask): void {
    this.sources.set(name, { template, ask });
  }

  address(name: string): string {
    return `${STATION_PROTOCOL}://${encodeURIComponent(name)}/{z}/{x}/{y}`;
  }

  /** What a map that asks for such an address gets. */
  async fetch(url: string): Promise<{ data: ArrayBuffer | null }> {
    const [name = '', z = '', x = '', y = ''] = url.slice(STATION_PROTOCOL.length + 3).split('/');
    const source = this.sources.get(decodeURIComponent(name));
    if (!source) throw new Error('these tiles are not known any more');
    const answer = await source.ask(source.template.replace('{z}', z).replace('{x}', x).replace('{y}', y));
    if (!answer) throw new Error('the station does not answer');
    // Where there is nothing to see there is nothing wrong either.
    if (answer.status === 204 || answer.status === 404) return { data: null };
    if (!answer.ok) throw new Error(`the station answers ${answer.status}`);
    return { data: await answer.arrayBuffer() };
  }
}

export const stationTiles = new StationTiles();
