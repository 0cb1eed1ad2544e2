import 'maplibre-gl/dist/maplibre-gl.css';
import './app.css';
import { mount } from 'svelte';
import Root from './Root.svelte';
import { browserStores } from './stores/stores';

mount(Root, { target: document.getElementById('app')!, props: { stores: browserStores() } });
