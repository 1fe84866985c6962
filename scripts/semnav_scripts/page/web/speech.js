// Commands by voice, where the browser can hear: it may send what it hears to its maker.

const Recognition = globalThis.SpeechRecognition ?? globalThis.webkitSpeechRecognition;
const LOCALES = { en: "en-US", de: "de-DE" };
const WHY = {
  "not-allowed": "The browser may not use the microphone.",
  "service-not-allowed": "The browser may not use the microphone.",
  "audio-capture": "There is no microphone.",
  "no-speech": "Nothing was heard.",
  network: "The browser cannot reach what recognises speech for it.",
};

/** Let a button listen. It stays hidden where the browser cannot. `heard(text, isFinal)`, `failed(why)`. */
export function listenBy(button, language, heard, failed) {
  if (!Recognition) return;
  let listening = null;
  button.hidden = false;
  button.onclick = () => {
    if (listening) return listening.stop();
    listening = new Recognition();
    listening.lang = LOCALES[language()] ?? navigator.language;
    listening.interimResults = true;
    listening.onresult = ({ results }) => {
      const latest = results[results.length - 1];
      heard(latest[0].transcript.trim(), latest.isFinal);
    };
    listening.onerror = ({ error }) => failed(WHY[error] ?? `Speech was not recognised: ${error}.`);
    listening.onend = () => show(null);
    listening.start();
    show(listening);
  };
  function show(state) {
    listening = state;
    button.textContent = state ? "Listening …" : "Speak";
    button.ariaPressed = String(Boolean(state));
  }
}
