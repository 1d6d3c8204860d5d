//! Which document is in front, and from where it is seen.

use glam::DVec3;
use trimloop_render::Direction;

use crate::document::Document;
use crate::navigation::Navigation;
use crate::section::Cuts;

use super::App;

/// From where a document is seen, and how it is cut: what is put away while another one is shown.
#[derive(Clone, Debug)]
pub(crate) struct Sight {
    view: Navigation,
    fitted: Option<Navigation>,
    past: Vec<Navigation>,
    future: Vec<Navigation>,
    cuts: Cuts,
}

/// Views that can be returned to.
const MOST_PAST: usize = 100;

impl App {
    /// Brings a document to the front, as it was seen and cut when it was there last.
    pub(super) fn activate(&mut self, index: usize) {
        if let Some(shown) = self.documents.iter_mut().find(|own| Some(own.id) == self.shown) {
            shown.sight = Some(Sight {
                view: self.view,
                fitted: self.fitted,
                past: std::mem::take(&mut self.past),
                future: std::mem::take(&mut self.future),
                cuts: self.cuts,
            });
        }
        self.active = index;
        self.tree.reset();
        self.past.clear();
        self.future.clear();
        let next = self.documents.get_mut(index);
        self.shown = next.as_ref().map(|own| own.id);
        match next.and_then(|own| own.sight.take()) {
            Some(sight) => {
                self.view = Navigation { up: self.look.up, ..sight.view };
                (self.fitted, self.cuts) = (sight.fitted, sight.cuts);
                (self.past, self.future) = (sight.past, sight.future);
                self.is_fitted = true;
            }
            None => {
                self.is_fitted = std::mem::take(&mut self.is_resumed);
                self.fitted = None;
                self.cuts = Cuts::new();
            }
        }
    }

    pub(super) fn close(&mut self, index: usize) {
        let id = self.documents.get(index).map(|document| document.id);
        self.drop_document(id);
    }

    /// Closes a document, if there is one of that number. Another one comes to the front only where it was there.
    pub(super) fn drop_document(&mut self, id: Option<u64>) {
        let Some(index) = self.documents.iter().position(|own| Some(own.id) == id) else { return };
        self.documents.remove(index);
        if index < self.active {
            self.active -= 1;
        } else if index == self.active {
            self.activate(self.active.min(self.documents.len().saturating_sub(1)));
        }
    }

    /// Remembers the present view before it changes.
    pub(super) fn remember(&mut self, view: Navigation) {
        self.past.push(view);
        self.future.clear();
        if self.past.len() > MOST_PAST {
            self.past.remove(0);
        }
    }

    pub(super) fn look_from(&mut self, direction: Direction) {
        self.remember(self.view);
        self.view.direction = direction;
    }

    /// Looks at all that is shown.
    pub(super) fn fit(&mut self) {
        let points = self.documents.get(self.active).map(|document| document.outline(None));
        self.look_at(&points.unwrap_or_default());
    }

    /// Looks at what is selected.
    pub(super) fn fit_selection(&mut self) {
        let points = self.documents.get_mut(self.active).map(Document::outline_of_selection);
        self.look_at(&points.unwrap_or_default());
    }

    pub(super) fn look_at(&mut self, points: &[DVec3]) {
        let before = self.view;
        self.view.fit(points, self.aspect);
        if before != self.view {
            self.remember(before);
        }
    }
}
