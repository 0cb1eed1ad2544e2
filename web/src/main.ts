import 'maplibre-gl/dist/maplibre-gl.css';
import './app.css';
import { mount } from 'svelte';
import App from './App.svelte';
import { browserStores, contextOf } from './stores/stores';

mount(App, { target: document.getElementById('app')!, context: contextOf(browserStores()) });
