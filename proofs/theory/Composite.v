(** * Composite quadrature: panels side by side

    Claim.  If a rule has order r with the constant c on a panel, then on n panels
    of width h from a on its error is at most

      c M (n h) h^r,

    where M bounds the r-th derivative of the integrand.  For [a, b] in n panels:

      Riemann     M (b - a) / 2 h           midpoint    M (b - a) / 24 h^2
      trapezoid   M (b - a) / 12 h^2        Simpson     M (b - a) / 2880 h^4

    where h = (b - a) / n is the width of a panel.  Simpson's panel has its midpoint
    besides its ends: in terms of the distance h / 2 of nodes it is M (b - a) / 180.

    Source.  Textbook numerical analysis.

    Assumptions.  Those of Quadrature.v on the whole interval.  n may be 0.

    The program computes optical depths so, and (with panels of several segments)
    radiances. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Sums Derivatives Quadrature.
Open Scope R_scope.

Definition composite (Q : rule) (f : R -> R) (a h : R) (n : nat) : R :=
  sum_over (seq 0 n) (fun i => apply_rule Q f (a + INR i * h) h).

Theorem composite_bound (Q : rule) (r : nat) (c : R) (f : nat -> R -> R) (a h M : R) (n : nat) :
  panel_bound Q r c -> 0 <= h -> derivatives r f a (a + INR n * h) ->
  (forall x, a <= x <= a + INR n * h -> Rabs (f r x) <= M) ->
  Rabs (RInt (f 0%nat) a (a + INR n * h) - composite Q (f 0%nat) a h n)
    <= c * M * (INR n * h) * h ^ r.
Proof.
  intros [Hr HQ] Hh. induction n as [| n IH]; intros Hf HM.
  - simpl. rewrite Rmult_0_l, Rplus_0_r, RInt_point.
    change (Rabs (0 - 0) <= c * M * 0 * h ^ r). rewrite Rminus_0_r, Rabs_R0. lra.
  - set (b := a + INR n * h).
    assert (0 <= INR n * h) by (apply Rmult_le_pos; [apply pos_INR | easy]).
    replace (a + INR (S n) * h) with (b + h) in * by (rewrite S_INR; unfold b; ring).
    assert (integral : RInt (f 0%nat) a (b + h) = RInt (f 0%nat) a b + RInt (f 0%nat) b (b + h)).
    { symmetry. apply (RInt_Chasles (V := R_CompleteNormedModule));
        apply (derivatives_integrable r f a (b + h)); unfold b in *; (easy || lra). }
    assert (before : Rabs (RInt (f 0%nat) a b - composite Q (f 0%nat) a h n)
      <= c * M * (INR n * h) * h ^ r).
    { apply IH; [apply derivatives_within with a (b + h) | intros x Hx; apply HM];
        unfold b in *; (easy || lra). }
    assert (last : Rabs (RInt (f 0%nat) b (b + h) - apply_rule Q (f 0%nat) b h)
      <= c * M * h ^ (r + 1)).
    { apply HQ; [easy | apply derivatives_within with a (b + h) | intros x Hx; apply HM];
        unfold b in *; (easy || lra). }
    unfold composite. rewrite sum_over_seq_S, integral, S_INR. fold b.
    fold (composite Q (f 0%nat) a h n).
    replace (_ + _ - (_ + _)) with ((RInt (f 0%nat) a b - composite Q (f 0%nat) a h n)
      + (RInt (f 0%nat) b (b + h) - apply_rule Q (f 0%nat) b h)) by ring.
    rewrite pow_add, pow_1 in last.
    eapply Rle_trans; [apply Rabs_triang | lra].
Qed.

(** The same for an interval in n >= 1 panels. *)
Lemma composite_interval (Q : rule) (r : nat) (c : R) (f : nat -> R -> R) (a b M : R) (n : nat) :
  let h := (b - a) / INR n in
  panel_bound Q r c -> (0 < n)%nat -> a <= b -> derivatives r f a b ->
  (forall x, a <= x <= b -> Rabs (f r x) <= M) ->
  Rabs (RInt (f 0%nat) a b - composite Q (f 0%nat) a h n) <= c * M * (b - a) * h ^ r.
Proof.
  intros h HQ Hn Hab Hf HM.
  assert (n_pos : 0 < INR n) by now apply lt_0_INR.
  assert (total : INR n * h = b - a) by (unfold h; field; lra).
  assert (h_pos : 0 <= h) by (apply Rdiv_le_0_compat; lra).
  assert (bound := composite_bound Q r c f a h M n HQ h_pos). rewrite total in bound.
  replace (a + (b - a)) with b in bound by ring. now apply bound.
Qed.

Section Rules.
Variables (f : nat -> R -> R) (a b M : R) (n : nat).
Let h := (b - a) / INR n.
Hypotheses (panels : (0 < n)%nat) (interval : a <= b).

Corollary composite_riemann_left :
  derivatives 1 f a b -> (forall x, a <= x <= b -> Rabs (f 1%nat x) <= M) ->
  Rabs (RInt (f 0%nat) a b - composite riemann_left (f 0%nat) a h n) <= M * (b - a) / 2 * h.
Proof.
  intros Hf HM. replace (M * (b - a) / 2 * h) with (1 / 2 * M * (b - a) * h ^ 1) by field.
  now apply composite_interval; [apply riemann_left_panel | ..].
Qed.

Corollary composite_riemann_right :
  derivatives 1 f a b -> (forall x, a <= x <= b -> Rabs (f 1%nat x) <= M) ->
  Rabs (RInt (f 0%nat) a b - composite riemann_right (f 0%nat) a h n) <= M * (b - a) / 2 * h.
Proof.
  intros Hf HM. replace (M * (b - a) / 2 * h) with (1 / 2 * M * (b - a) * h ^ 1) by field.
  now apply composite_interval; [apply riemann_right_panel | ..].
Qed.

Corollary composite_midpoint :
  derivatives 2 f a b -> (forall x, a <= x <= b -> Rabs (f 2%nat x) <= M) ->
  Rabs (RInt (f 0%nat) a b - composite midpoint (f 0%nat) a h n) <= M * (b - a) / 24 * h ^ 2.
Proof.
  intros Hf HM. replace (M * (b - a) / 24) with (1 / 24 * M * (b - a)) by field.
  now apply composite_interval; [apply midpoint_panel | ..].
Qed.

Corollary composite_trapezoid :
  derivatives 2 f a b -> (forall x, a <= x <= b -> Rabs (f 2%nat x) <= M) ->
  Rabs (RInt (f 0%nat) a b - composite trapezoid (f 0%nat) a h n) <= M * (b - a) / 12 * h ^ 2.
Proof.
  intros Hf HM. replace (M * (b - a) / 12) with (1 / 12 * M * (b - a)) by field.
  now apply composite_interval; [apply trapezoid_panel | ..].
Qed.

Corollary composite_simpson :
  derivatives 4 f a b -> (forall x, a <= x <= b -> Rabs (f 4%nat x) <= M) ->
  Rabs (RInt (f 0%nat) a b - composite simpson (f 0%nat) a h n) <= M * (b - a) / 2880 * h ^ 4.
Proof.
  intros Hf HM. replace (M * (b - a) / 2880) with (1 / 2880 * M * (b - a)) by field.
  now apply composite_interval; [apply simpson_panel | ..].
Qed.
End Rules.
