(** * Quadrature rules on one panel, with sharp constants

    Claim.  On a panel [a, a + h] the error of a rule is at most c M h^(r + 1),
    where M bounds the r-th derivative of the integrand on the panel:

      Riemann, left or right   r = 1   c = 1/2
      midpoint                 r = 2   c = 1/24
      trapezoid                r = 2   c = 1/12
      Simpson                  r = 4   c = 1/2880

    Source.  Textbook numerical analysis; the constants are the known best ones
    (equality holds for a polynomial of degree r).

    Assumptions.  The integrand has r derivatives on the panel, two-sided at its
    ends; r >= 1, so that it is integrable.  The r-th need not be continuous.

    A method's order follows from the bound of one panel of its rules: Composite.v
    adds panels up, Nested.v puts one rule into another.  TaylorRule.v has a bound,
    with larger constants, for every rule that is exact on polynomials.

    The proofs take the error as a function E of the width (of half the width where
    the rule is symmetric), and differentiate it until a single term is left. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Sums Derivatives.
Import ListNotations.
Open Scope R_scope.

(** Nodes on [0, 1] and weights. *)
Definition rule := list (R * R).

Definition apply_rule (Q : rule) (f : R -> R) (a h : R) : R :=
  h * sum_over Q (fun '(c, w) => w * f (a + c * h)).

Definition riemann_left : rule := [(0, 1)].
Definition riemann_right : rule := [(1, 1)].
Definition midpoint : rule := [(1/2, 1)].
Definition trapezoid : rule := [(0, 1/2); (1, 1/2)].
Definition simpson : rule := [(0, 1/6); (1/2, 2/3); (1, 1/6)].
Definition boole : rule := [(0, 7/90); (1/4, 16/45); (1/2, 2/15); (3/4, 16/45); (1, 7/90)].
Definition gauss_2 : rule := [((1 - sqrt (1/3)) / 2, 1/2); ((1 + sqrt (1/3)) / 2, 1/2)].
Definition gauss_3 : rule :=
  [((1 - sqrt (3/5)) / 2, 5/18); (1/2, 4/9); ((1 + sqrt (3/5)) / 2, 5/18)].

(** Order r with the constant c, on every panel and for every integrand. *)
Definition panel_bound (Q : rule) (r : nat) (c : R) : Prop :=
  (1 <= r)%nat /\
  forall (f : nat -> R -> R) (a h M : R),
  0 <= h -> derivatives r f a (a + h) ->
  (forall x, a <= x <= a + h -> Rabs (f r x) <= M) ->
  Rabs (RInt (f 0%nat) a (a + h) - apply_rule Q (f 0%nat) a h) <= c * M * h ^ (r + 1).

Lemma panel_bound_nonnegative (Q : rule) (r : nat) (c : R) : panel_bound Q r c -> 0 <= c.
Proof.
  intros [_ H]. replace c with (c * 1 * 1 ^ (r + 1)) by (rewrite pow1; ring).
  eapply Rle_trans; [apply Rabs_pos | apply (H (fun _ _ => 0) 0 1 1); [lra | |]].
  - intros k x _ _. apply (is_derive_const (V := R_NormedModule)).
  - intros x _. rewrite Rabs_R0. lra.
Qed.

(** It is enough to look at the primitive of the integrand, as F 0 with F 1 the
    integrand.  The panel is given by its front or by its centre. *)
Lemma panel_bound_from_front (Q : rule) (r : nat) (c : R) :
  (1 <= r)%nat ->
  (forall (F : nat -> R -> R) (a h M : R),
    0 <= h -> derivatives (S r) F a (a + h) ->
    (forall x, a <= x <= a + h -> Rabs (F (S r) x) <= M) ->
    Rabs (F 0%nat (a + h) - F 0%nat a - apply_rule Q (F 1%nat) a h) <= c * M * h ^ (r + 1)) ->
  panel_bound Q r c.
Proof.
  intros Hr H. split; [easy |]. intros f a h M Hh Hf HM.
  destruct (primitive_exists r f a (a + h) Hr) as [F HF]; [lra | easy |].
  assert (integral := integral_by_primitive r _ a (a + h) a (a + h) Hr HF).
  simpl in integral. rewrite integral by lra. now apply (H (with_primitive F f)).
Qed.

Lemma panel_bound_from_centre (Q : rule) (r : nat) (c : R) :
  (1 <= r)%nat ->
  (forall (F : nat -> R -> R) (m u M : R),
    0 <= u -> derivatives (S r) F (m - u) (m + u) ->
    (forall x, m - u <= x <= m + u -> Rabs (F (S r) x) <= M) ->
    Rabs (F 0%nat (m + u) - F 0%nat (m - u) - apply_rule Q (F 1%nat) (m - u) (2 * u))
      <= c * M * (2 * u) ^ (r + 1)) ->
  panel_bound Q r c.
Proof.
  intros Hr H. apply panel_bound_from_front; [easy |]. intros F a h M Hh HF HM.
  assert (Hc := H F (a + h / 2) (h / 2) M).
  replace (a + h / 2 - h / 2) with a in Hc by field.
  replace (a + h / 2 + h / 2) with (a + h) in Hc by field.
  replace (2 * (h / 2)) with h in Hc by field. apply Hc; [lra | easy | easy].
Qed.

(** That E 0 at [width] is the error in the goal. *)
Ltac name_error E width :=
  match goal with |- Rabs ?error <= _ => replace error with (E 0%nat width) end;
  [| unfold E, apply_rule; simpl; rewrite ?Rmult_0_l, ?Rmult_1_l, ?Rplus_0_r;
     repeat match goal with |- context [?m - ?u + 1 / 2 * (2 * ?u)] =>
       replace (m - u + 1 / 2 * (2 * u)) with m by field end;
     repeat match goal with |- context [?m - ?u + 2 * ?u] =>
       replace (m - u + 2 * u) with (m + u) by ring end; field ].

(** The k-th derivative in a list of functions, and that it is one: [HF] gives the
    derivatives of the functions they are made of. *)
Ltac derivatives_of_error E HF :=
  intros k ? ? ?; destruct k as [| [| [| [| k]]]]; try lia; unfold E; cbn [nth];
  (auto_derive;
   [ repeat split; eexists; apply HF; (lia || lra)
   | match type of HF with derivatives _ ?F _ _ =>
       repeat match goal with |- context [Derive (fun y => F ?i y) ?z] =>
         replace (Derive (fun y => F i y) z) with (F (S i) z)
           by (symmetry; apply is_derive_unique, HF; (lia || lra)) end end;
     unfold Rminus; field ]).

(** The error and its derivatives vanish at 0. *)
Ltac vanish_at_0 E :=
  intros k ?; destruct k as [| [| [| [| k]]]]; try lia; unfold E; cbn [nth];
  rewrite ?Rplus_0_r, ?Rminus_0_r; field.

Theorem riemann_left_panel : panel_bound riemann_left 1 (1 / 2).
Proof.
  apply panel_bound_from_front; [lia |]. intros F a h M Hh HF HM.
  set (E k := nth k
    [(fun x => F 0%nat (a + x) - F 0%nat a - x * F 1%nat a);
     (fun x => F 1%nat (a + x) - F 1%nat a);
     (fun x => F 2%nat (a + x))] (fun _ => 0)).
  name_error E h.
  replace (1 / 2 * M * h ^ (1 + 1)) with (M * taylor_term (2 + 0) h)
    by (unfold taylor_term; simpl; field).
  apply bound_from_derivatives; [easy | derivatives_of_error E HF | vanish_at_0 E |].
  intros x Hx. replace (M * taylor_term 0 x) with M by (unfold taylor_term; simpl; field).
  apply HM. lra.
Qed.

Theorem riemann_right_panel : panel_bound riemann_right 1 (1 / 2).
Proof.
  apply panel_bound_from_front; [lia |]. intros F a h M Hh HF HM.
  set (E k := nth k
    [(fun x => F 0%nat (a + x) - F 0%nat a - x * F 1%nat (a + x));
     (fun x => - x * F 2%nat (a + x))] (fun _ => 0)).
  name_error E h.
  replace (1 / 2 * M * h ^ (1 + 1)) with (M * taylor_term (1 + 1) h)
    by (unfold taylor_term; simpl; field).
  apply bound_from_derivatives; [easy | derivatives_of_error E HF | vanish_at_0 E |].
  intros x Hx. replace (M * taylor_term 1 x) with (x * M) by (unfold taylor_term; simpl; field).
  unfold E; cbn [nth]. rewrite Rabs_mult, Rabs_Ropp, (Rabs_pos_eq x) by lra.
  apply Rmult_le_compat_l; [| apply HM]; lra.
Qed.

Theorem trapezoid_panel : panel_bound trapezoid 2 (1 / 12).
Proof.
  apply panel_bound_from_front; [lia |]. intros F a h M Hh HF HM.
  set (E k := nth k
    [(fun x => F 0%nat (a + x) - F 0%nat a - x * (F 1%nat a + F 1%nat (a + x)) / 2);
     (fun x => (F 1%nat (a + x) - F 1%nat a - x * F 2%nat (a + x)) / 2);
     (fun x => - (x / 2) * F 3%nat (a + x))] (fun _ => 0)).
  name_error E h.
  replace (1 / 12 * M * h ^ (2 + 1)) with (M / 2 * taylor_term (2 + 1) h)
    by (unfold taylor_term; simpl; field).
  apply bound_from_derivatives; [easy | derivatives_of_error E HF | vanish_at_0 E |].
  intros x Hx.
  replace (M / 2 * taylor_term 1 x) with (x / 2 * M) by (unfold taylor_term; simpl; field).
  unfold E; cbn [nth]. rewrite Rabs_mult, Rabs_Ropp, (Rabs_pos_eq (x / 2)) by lra.
  apply Rmult_le_compat_l; [| apply HM]; lra.
Qed.

Theorem midpoint_panel : panel_bound midpoint 2 (1 / 24).
Proof.
  apply panel_bound_from_centre; [lia |]. intros F m u M Hu HF HM.
  set (E k := nth k
    [(fun x => F 0%nat (m + x) - F 0%nat (m - x) - 2 * x * F 1%nat m);
     (fun x => F 1%nat (m + x) + F 1%nat (m - x) - 2 * F 1%nat m);
     (fun x => F 2%nat (m + x) - F 2%nat (m - x));
     (fun x => F 3%nat (m + x) + F 3%nat (m - x))] (fun _ => 0)).
  name_error E u.
  replace (1 / 24 * M * (2 * u) ^ (2 + 1)) with (2 * M * taylor_term (3 + 0) u)
    by (unfold taylor_term; simpl; field).
  apply bound_from_derivatives; [easy | derivatives_of_error E HF | vanish_at_0 E |].
  intros x Hx. replace (2 * M * taylor_term 0 x) with (M + M) by (unfold taylor_term; simpl; field).
  eapply Rle_trans; [apply Rabs_triang | apply Rplus_le_compat; apply HM; lra].
Qed.

Theorem simpson_panel : panel_bound simpson 4 (1 / 2880).
Proof.
  apply panel_bound_from_centre; [lia |]. intros F m u M Hu HF HM.
  set (E k := nth k
    [(fun x => F 0%nat (m + x) - F 0%nat (m - x)
               - x / 3 * (F 1%nat (m - x) + 4 * F 1%nat m + F 1%nat (m + x)));
     (fun x => 2 / 3 * (F 1%nat (m + x) + F 1%nat (m - x)) - 4 / 3 * F 1%nat m
               - x / 3 * (F 2%nat (m + x) - F 2%nat (m - x)));
     (fun x => 1 / 3 * (F 2%nat (m + x) - F 2%nat (m - x))
               - x / 3 * (F 3%nat (m + x) + F 3%nat (m - x)));
     (fun x => - (x / 3) * (F 4%nat (m + x) - F 4%nat (m - x)))] (fun _ => 0)).
  name_error E u.
  replace (1 / 2880 * M * (2 * u) ^ (4 + 1)) with (4 / 3 * M * taylor_term (3 + 2) u)
    by (unfold taylor_term; simpl; field).
  apply bound_from_derivatives; [easy | derivatives_of_error E HF | vanish_at_0 E |].
  intros x Hx.
  assert (change : Rabs (F 4%nat (m + x) - F 4%nat (m - x)) <= 2 * M * taylor_term (1 + 0) x).
  { set (E4 k := nth k
      [(fun x => F 4%nat (m + x) - F 4%nat (m - x));
       (fun x => F 5%nat (m + x) + F 5%nat (m - x))] (fun _ => 0)).
    change (Rabs (E4 0%nat x) <= 2 * M * taylor_term (1 + 0) x).
    apply bound_from_derivatives; [lra | derivatives_of_error E4 HF | vanish_at_0 E4 |].
    intros y Hy.
    replace (2 * M * taylor_term 0 y) with (M + M) by (unfold taylor_term; simpl; field).
    eapply Rle_trans; [apply Rabs_triang | apply Rplus_le_compat; apply HM; lra]. }
  replace (4 / 3 * M * taylor_term 2 x) with (x / 3 * (2 * M * taylor_term (1 + 0) x))
    by (unfold taylor_term; simpl; field).
  unfold E; cbn [nth]. rewrite Rabs_mult, Rabs_Ropp, (Rabs_pos_eq (x / 3)) by lra.
  apply Rmult_le_compat_l; [lra | exact change].
Qed.
