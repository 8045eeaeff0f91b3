//! Plans of scenes.
